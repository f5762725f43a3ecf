/// What the modes of all kinds of laws have in common: the law, and the mode for any contacts.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "contact/unequal_blades.hpp"
#include "modes/contact_mode.hpp"
#include "modes/contact_modes.hpp"
#include "modes/contact_phase.hpp"

namespace rubatlas::modes {

/// `Blade`: the law of one blade; `Pair`: the Runge–Kutta coefficients of modes in steps.
template <class Blade, class Pair>
class ModesOfLaw : public ContactModes {
 public:
  using Law = contact::UnequalBlades<Blade>;

  ModesOfLaw(const ModesRequest& request, Law law)
      : law_(std::move(law)), setup_{&request.machine, &law_, request.limits, &request.meter} {}

  [[nodiscard]] const contact::Geometry& geometry(int blade) const override {
    return law_.of(blade).geometry();
  }
  [[nodiscard]] std::uint64_t curve_evaluations() const override { return modes::curve_evaluations(law_); }
  std::int64_t price_of_searches() override {
    if (kShortSearches) return 0;
    const std::uint64_t evaluations = curve_evaluations();
    const auto unpaid =
        static_cast<std::int64_t>(evaluations - std::exchange(paid_evaluations_, evaluations));
    return unpaid * price_of_curve<Law>();
  }
  void searches_are_paid() override { paid_evaluations_ = curve_evaluations(); }

 protected:
  template <class Mode>
  [[nodiscard]] std::unique_ptr<Phase> phase_of() const {
    return std::make_unique<ContactPhase<Mode, Pair>>(setup_);
  }
  [[nodiscard]] const auto& blade(const OpenContact& contact) const { return law_.of(contact.blade); }

  Law law_;
  ContactSetup<Law> setup_;

 private:
  static constexpr bool kShortSearches = Law::kHasBending;
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price has been told
};

/// A maker of the modes `Modes` of one law.
template <class Modes>
MakeModes maker_of(typename Modes::Law law) {
  return [law = std::move(law)](const ModesRequest& request) -> std::unique_ptr<ContactModes> {
    return std::make_unique<Modes>(request, request.lost.empty() ? law : law.shortened(request.lost));
  };
}

}  // namespace rubatlas::modes
