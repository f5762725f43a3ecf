/// A function of one number, as a search takes it: called, never kept, never copied.
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>

namespace rubatlas::integrate {

/// Any callable double → double, which must outlive the view: the argument of a search, compiled once for all
/// guards. An indirect call is small beside a state of dense output, and nothing is allocated (C++26:
/// std::function_ref).
class FunctionView {
 public:
  template <class Function>
  requires(!std::same_as<std::remove_cvref_t<Function>, FunctionView> && std::invocable<Function&, double>)
      // A lambda is passed as one; a view is copied, by what `requires` says.
      // NOLINTNEXTLINE(google-explicit-constructor, bugprone-forwarding-reference-overload)
      FunctionView(Function&& function)
      : function_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
        call_([](void* called, double argument) -> double {
          return (*static_cast<std::remove_reference_t<Function>*>(called))(argument);
        }) {}

  double operator()(double argument) const { return call_(function_, argument); }

 private:
  void* function_;
  double (*call_)(void*, double);
};

}  // namespace rubatlas::integrate
