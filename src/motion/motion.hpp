/// The motion of the rotor from revolution to revolution, as a hybrid system: modes, the guards that end
/// them, and the resets from one to the next.
///
/// This class executes modes and resets and does not know their equations: `modes/contact_modes.hpp` has
/// both. Nor does it know what is kept of the motion: a listener receives each piece of the motion and each
/// event, and asks the piece for the states that it needs. Time counts from the start of the revolution, so
/// that it does not lose digits in a long run.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "modes/contact_modes.hpp"
#include "modes/flight.hpp"
#include "modes/touchdown_search.hpp"
#include "motion/point_motion.hpp"

namespace rubatlas::motion {

class Motion final : public PointMotion {
 public:
  Motion(rotor::Machine machine, std::unique_ptr<modes::Law> law, const modes::ContactLimits& limits,
         modes::MakePhases* make_phases);

  /// Blades with g > 0 are in contact (MODEL 4.4).
  ending::StatusDetail start(const PointStart& start) override;
  ending::StatusDetail revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                  int number) override;
  /// Contacts stay, with their slip directions (MODEL 4.4), where the blade still reaches the ring.
  ending::StatusDetail take_over(PointMotion& before) override;

  [[nodiscard]] rotor::ShaftAndRing state() const override { return state_; }
  /// The state of a ring that moves.
  [[nodiscard]] Memory memory() const override;
  [[nodiscard]] WorkCounts work() const override;

 private:
  using Contact = std::vector<modes::OpenContact>::iterator;

  [[nodiscard]] std::vector<contact::Geometry> geometries() const;

  // Modes.
  modes::ModeEnd fly(double period, modes::MotionListener& listener);
  modes::ModeEnd touch(double period, modes::MotionListener& listener);
  ending::StatusDetail finish_revolution(double period);
  ending::StatusDetail begin_mode();

  // Contacts.
  [[nodiscard]] const modes::Law& law() const { return modes_.law(); }
  [[nodiscard]] rotor::ContactState unbent() const { return rotor::full_state(state_, time_, 0.0); }
  [[nodiscard]] modes::TipPlace place(int blade) const { return modes_.tip_place(blade, unbent()); }
  bool find_contacts(const std::vector<modes::OpenContact>& held, int touching, bool goes_on = false);
  bool open(int blade, const modes::TipPlace& at);
  bool place_ring();
  ending::StatusDetail settle_others(int blade, modes::MotionListener& listener);
  /// τ of the last slip reversal of a tip since it has touched down, and of the one before.
  struct Reversals {
    double last = -std::numeric_limits<double>::infinity();
    double before = -std::numeric_limits<double>::infinity();
  };
  Reversals& reversals(int blade) { return reversals_[static_cast<std::size_t>(blade)]; }
  double reversal_cycle(int blade);

  // Resets.
  void tell(modes::MotionListener& listener, modes::Guard guard, int blade, double slip) const;
  ending::StatusDetail reset(const modes::ModeEnd& end, modes::MotionListener& listener);
  ending::StatusDetail touch_down(int blade, modes::MotionListener& listener);
  ending::StatusDetail lift_off(Contact contact, modes::MotionListener& listener);
  ending::StatusDetail snap(Contact contact, modes::MotionListener& listener);
  ending::StatusDetail come_loose(Contact contact, modes::MotionListener& listener);
  ending::StatusDetail reverse_slip(Contact contact, modes::MotionListener& listener);

  rotor::Machine machine_;
  modes::WorkMeter meter_;
  modes::ContactModes modes_;
  modes::Flight flight_;
  modes::TouchdownSearch search_;
  std::vector<modes::OpenContact> contacts_;
  std::vector<Reversals> reversals_;  ///< of each blade
  rotor::ShaftAndRing state_ = rotor::ShaftAndRing::Zero();
  double time_ = 0.0;
  WorkCounts work_;
  modes::Phase* phase_ = nullptr;  ///< of the present mode in contact; null in flight
  /// What ended the last mode, until the next begins; horizon: there was none.
  std::optional<modes::Guard> ended_by_ = modes::Guard::horizon;
};

}  // namespace rubatlas::motion
