/// Mode: elastic blades whose tips may rest on the ring (`modes/rest_of_elastic_blades.hpp`).
#pragma once

#include <cstddef>

#include "compared/guards.hpp"
#include "compared/solved.hpp"
#include "contact/tip.hpp"
#include "modes/rest_of_elastic_blades.hpp"

namespace rubatlas::compared {

/// The equations of `Solved`. An open contact with slip 0 rests, and is found from its bending and amplitude.
class StickingElastic : public Solved {
 public:
  explicit StickingElastic(const modes::ContactSetup& setup)
      : Solved(setup), rest_(*setup.machine, *setup.law) {}
  static constexpr bool kBendsFollowPath = false;

  /// A tip at rest comes loose where it is positive.
  [[nodiscard]] double excess(std::size_t contact, const FullState& state) const {
    if (is_stopped()) return -1.0;
    const modes::OpenContact& open = contacts_[contact];
    const double result = rest_.looseness(open, rest_.rest(open, state));
    pay_curves();
    return result;
  }
  /// c [-] that holds a tip at rest, or under which it slips.
  [[nodiscard]] double friction_of(std::size_t contact, const contact::TipForce& force,
                                   const FullState& state) const {
    const modes::OpenContact& open = contacts_[contact];
    if (open.slip != 0.0) return Solved::friction_of(contact, force, state);
    const auto there = rest_.rest(open, state);
    return there ? there->coefficient : 0.0;
  }
  /// The force of tips that are all at rest is smooth.
  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    return error_of(step, acceleration_, all_at_rest(), [](const FullState&) { return 0.0; });
  }
  [[nodiscard]] modes::ModeEnd without_force() const {
    // A tip at rest that nothing can hold beyond the start of the step.
    const modes::OpenContact& lost = contacts_[lost_];
    if (lost.slip == 0.0) return {modes::Guard::comes_loose, lost.blade};
    return Solved::without_force();
  }

  template <class Search>
  void guards(Search& search) const {
    guards_of_tips(*this, search);
  }

 private:
  modes::RestOfElasticBlades rest_;
};

}  // namespace rubatlas::compared
