/// The modes in contact of one contact law on one machine, and what becomes of its contacts at a reset.
///
/// A motion executes modes and resets and does not know their equations. Each kind of law implements this
/// interface once (`modes_of_<kind>.hpp`); a law does not override what cannot occur under it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "contact/pose.hpp"
#include "modes/contact_limits.hpp"
#include "modes/open_contact.hpp"
#include "modes/phase.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

/// What has become of a contact: it stands in equilibrium, it is free, or neither (MODEL 5).
enum class Standing : std::uint8_t { stands, free, lost };

/// Where the tip of a contact is: its pose, and dφ/dτ there.
struct TipPlace {
  contact::Pose pose;
  double speed;
};

class ContactModes {
 public:
  ContactModes() = default;
  ContactModes(const ContactModes&) = delete;  // phases point at their law
  ContactModes& operator=(const ContactModes&) = delete;
  virtual ~ContactModes() = default;

  // Phases, one a mode; null where the law has no such mode.

  [[nodiscard]] Phase* solved() const { return solved_.get(); }  ///< any contacts; never null
  [[nodiscard]] Phase* collocated() const { return collocated_.get(); }
  [[nodiscard]] Phase* skimming() const { return skimming_.get(); }
  [[nodiscard]] Phase* sticking() const { return sticking_.get(); }  ///< tips that can stick
  /// Tips that always slip and come to rest where their slip reversals accumulate, under another law.
  [[nodiscard]] Phase* resting() const { return resting_.get(); }
  /// Whether tips can be at rest in any way.
  [[nodiscard]] bool can_rest() const { return sticking_ || resting_; }

  /// Calls `use` with each phase that there is.
  template <class Use>
  void each_phase(Use use) const {
    for (const Phase* phase : {solved(), collocated(), skimming(), sticking(), resting()}) {
      if (phase != nullptr) use(*phase);
    }
  }

  [[nodiscard]] virtual const contact::Geometry& geometry(int blade) const = 0;
  /// How often curves of blades have been evaluated.
  [[nodiscard]] virtual std::uint64_t curve_evaluations() const = 0;
  /// Price of the searches for equilibria since the last phase or call; nothing where they are short [ns].
  virtual std::int64_t price_of_searches() = 0;
  /// A phase has paid for its own.
  virtual void searches_are_paid() = 0;

  // Resets of one contact.

  /// A contact opens. False where no force exists (MODEL 5).
  [[nodiscard]] virtual bool open(const TipPlace& /*at*/, OpenContact& /*contact*/) const { return true; }
  /// A contact goes on where the tip stands now, after a change of the blade or of its speed.
  [[nodiscard]] virtual Standing keep(const TipPlace& at, OpenContact& /*contact*/) const {
    return at.pose.gap <= 0.0 ? Standing::free : Standing::stands;
  }
  /// Finds the bending that another mode has left again where the tip stands. False where there is none.
  [[nodiscard]] virtual bool follow(const TipPlace& /*at*/, OpenContact& /*contact*/) const { return true; }
  /// Goes from the end of a branch to the next equilibrium.
  [[nodiscard]] virtual Standing snap(const TipPlace& /*at*/, OpenContact& /*contact*/) const {
    return Standing::lost;
  }
  /// Finds the bending after a change of the slip direction. False where there is none.
  [[nodiscard]] virtual bool bend_anew(const TipPlace& /*at*/, OpenContact& /*contact*/) const {
    return true;
  }
  /// A blade that has unbent stays in contact, standing straight.
  [[nodiscard]] virtual bool straightens(const TipPlace& /*at*/, OpenContact& /*contact*/) const {
    return false;
  }

  /// The contact of a blade goes on beyond the ring while it has a force.
  [[nodiscard]] virtual bool releases_at_fold(int /*blade*/) const { return false; }
  /// Whether the first of these blades, which has just touched down, begins to skim: it would hop at most
  /// `hop` [m] high, and return.
  [[nodiscard]] virtual bool begins_to_skim(const rotor::ContactState& /*state*/,
                                            const std::vector<OpenContact>& /*contacts*/,
                                            double /*hop*/) const {
    return false;
  }

  // Rest.

  using Tell = std::function<void(const OpenContact&)>;
  /// Frees the tips at rest that friction cannot hold in a state, and calls `tell` for each of them. False
  /// where a tip is left neither rest nor a direction of slip.
  virtual bool settle(const rotor::ContactState& /*state*/, std::vector<OpenContact>& /*contacts*/,
                      const Tell& /*tell*/) {
    return true;
  }
  /// The slip velocity of a tip has come to zero: it rests or slips. False where it can do neither.
  virtual bool arrest(const rotor::ContactState& /*state*/, std::vector<OpenContact>& /*contacts*/,
                      std::size_t /*contact*/) {
    return false;
  }
  /// A tip at rest that friction no longer holds slips. False where it has no direction.
  virtual bool let_go(const rotor::ContactState& /*state*/, std::vector<OpenContact>& /*contacts*/,
                      std::size_t /*contact*/) {
    return false;
  }
  /// Whether the model says what follows where slip reversals of a tip accumulate.
  [[nodiscard]] virtual bool has_law_of_rest() const { return true; }
  /// The limit of slip reversals that accumulate: the tip comes to rest where friction can hold it. False,
  /// and nothing changed, where friction cannot hold it yet.
  virtual bool comes_to_rest(const rotor::ContactState& /*state*/, OpenContact& /*contact*/) { return false; }
  /// Contacts in the unknowns of the law of tips at rest.
  [[nodiscard]] virtual std::vector<OpenContact> at_rest(const std::vector<OpenContact>& contacts) const {
    return contacts;
  }
  /// A contact under the law of tips at rest, as another motion takes it over: a tip at rest comes loose
  /// where the machine changes, and s becomes the side to which its blade is bent.
  virtual void leave_law_of_rest(OpenContact& contact) const {
    if (contact.slip == 0.0) contact.slip = std::copysign(1.0, contact.bend.modulus);
  }

  // A ring without mass.

  using Touches = std::function<bool(int blade)>;
  /// Puts such a ring where its spring balances the blades in contact; `touches` opens the contact of a blade
  /// that reaches into it there. False where there is no such place (MODEL 5).
  virtual bool place_ring(rotor::ShaftAndRing& /*state*/, double /*time*/,
                          std::vector<OpenContact>& /*contacts*/, const Touches& /*touches*/) {
    return true;
  }

 protected:
  std::unique_ptr<Phase> solved_;
  std::unique_ptr<Phase> collocated_;
  std::unique_ptr<Phase> skimming_;
  std::unique_ptr<Phase> sticking_;
  std::unique_ptr<Phase> resting_;
};

/// What the modes of a motion are made for.
struct ModesRequest {
  const rotor::Machine& machine;  ///< outlives the modes, as the meter does
  ContactLimits limits;
  WorkMeter& meter;
  bool collocates;               ///< contacts that collocation can solve are left to it
  std::span<const double> lost;  ///< lengths that the blades have lost [m]; empty where none wears
};
/// Makes the modes of one law: `modes_of_<kind>.hpp` has the makers.
using MakeModes = std::function<std::unique_ptr<ContactModes>(const ModesRequest&)>;

}  // namespace rubatlas::modes
