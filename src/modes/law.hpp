/// A law of contact as the modes know it: what a blade does where it stands, and what becomes of its contact
/// at a reset. Each kind of law implements this interface once (`laws.hpp`); it does not override
/// what cannot occur under it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collocation/arc_law.hpp"
#include "collocation/blades_in_contact.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/tip.hpp"
#include "contact/unequal_blades.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

struct ContactSetup;

/// A contact that is open: which blade, its slip direction, and what its blade's equilibrium is found from,
/// all 0 where that is not known.
using OpenContact = collocation::Touch;
inline bool any_rests(std::span<const OpenContact> contacts) {
  return std::ranges::count(contacts, 0.0, &OpenContact::slip) > 0;
}

/// What has become of a contact: it stands in equilibrium, it is free, or neither (MODEL 5).
enum class Standing : std::uint8_t { stands, free, lost };

/// Where the tip of a contact is: its pose, and dφ/dτ there.
struct TipPlace {
  contact::Pose pose;
  double speed;
};

/// Who judges which tips rest on the ring, and which slip.
class RestJudge {
 public:
  RestJudge() = default;
  RestJudge(const RestJudge&) = delete;
  RestJudge& operator=(const RestJudge&) = delete;
  virtual ~RestJudge() = default;

  /// Frees the tips at rest that friction cannot hold in a state. False where a tip is left neither rest nor
  /// a direction of slip (MODEL 5).
  virtual bool settle(const rotor::ContactState& state, std::vector<OpenContact>& contacts) = 0;
  // Of one of the contacts in a state:
  /// The slip velocity of its tip has come to zero: it rests or slips. False where it can do neither.
  virtual bool arrest(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                      OpenContact& contact) = 0;
  /// Its tip at rest, which friction no longer holds, slips. False where it has no direction.
  virtual bool let_go(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
                      OpenContact& contact) = 0;
};

class Law {
 public:
  Law() = default;
  Law& operator=(const Law&) = delete;  // phases point at it
  virtual ~Law() = default;
  /// The law of the same blades, each shorter at its tip by what it has lost [m]; empty: none has.
  [[nodiscard]] virtual std::unique_ptr<Law> of_shortened(std::span<const double> lost) const = 0;

  [[nodiscard]] virtual const contact::Geometry& geometry(int blade) const = 0;
  /// The force of an open contact where its blade stands; updates its guesses. False where there is none, or
  /// where it does not follow from the place of the tip.
  virtual bool respond(const TipPlace& /*at*/, OpenContact& /*contact*/, contact::TipForce& /*force*/) const {
    return false;
  }
  /// c [-] of a tip that slips in the direction s under a force (MODEL 4.3).
  [[nodiscard]] virtual double friction_coefficient(int blade, const contact::TipForce& force,
                                                    double slip) const = 0;
  /// A tip may lift off where its blade has pushed the ring outwards, and touch down there.
  [[nodiscard]] virtual bool lifts_off_inside() const { return false; }
  /// Without a table a search may take milliseconds, and is paid for at once.
  [[nodiscard]] virtual bool searches_long() const { return false; }
  /// How often curves of blades have been evaluated.
  [[nodiscard]] virtual std::uint64_t evaluations() const { return 0; }
  /// The law of the arcs of these contacts.
  [[nodiscard]] virtual std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                                  double max_shortening) const = 0;

  // Ends of a contact and of its branch.

  /// The contact of a blade goes on beyond the ring while it has a force.
  [[nodiscard]] virtual bool releases_at_fold(int /*blade*/) const { return false; }
  /// Tips that hop without end skim (MODEL 4.9).
  [[nodiscard]] virtual bool may_skim() const { return false; }

  // Resets of one contact.

  /// A contact opens. False where no force exists (MODEL 5).
  [[nodiscard]] virtual bool open(const TipPlace& /*at*/, OpenContact& /*contact*/) const { return true; }
  /// A contact goes on where the tip stands now, after a change of the blade or of its speed.
  [[nodiscard]] virtual Standing keep(const TipPlace& at, OpenContact& /*contact*/) const {
    return at.pose.gap <= 0.0 ? Standing::free : Standing::stands;
  }
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

  // Rest.

  /// Who judges tips that stick; null where none does.
  [[nodiscard]] virtual std::unique_ptr<RestJudge> rest_judge(const ContactSetup& /*setup*/) const {
    return nullptr;
  }
  // Where slip reversals accumulate (MODEL 4.4):
  /// Whether the model says what follows there.
  [[nodiscard]] virtual bool knows_rest() const { return law_of_rest(0).has_value(); }
  /// The law of a blade whose tip then rests, held by a friction coefficient within [−μ, μ], if it is another
  /// one. A tip that slips has the same force under both.
  [[nodiscard]] virtual std::optional<contact::DirectedElastica> law_of_rest(int /*blade*/) const {
    return std::nullopt;
  }

 protected:
  Law(const Law&) = default;
};

/// What all kinds have in common: blades with a law each.
template <class Derived, class Blade>
class LawOfBlades : public Law {
 public:
  using Blades = contact::UnequalBlades<Blade>;
  explicit LawOfBlades(Blades blades) : blades_(std::move(blades)) {}

  [[nodiscard]] std::unique_ptr<Law> of_shortened(std::span<const double> lost) const override {
    return std::make_unique<Derived>(lost.empty() ? blades_ : blades_.shortened(lost));
  }
  [[nodiscard]] const contact::Geometry& geometry(int blade) const override {
    return blades_.of(blade).geometry();
  }
  [[nodiscard]] double friction_coefficient(int blade, const contact::TipForce& force,
                                            double slip) const override {
    return of(blade).friction().coefficient(force.slip_velocity, slip);
  }
  [[nodiscard]] const Blades& blades() const { return blades_; }
  [[nodiscard]] const Blade& of(int blade) const { return blades_.of(blade); }

 private:
  Blades blades_;
};

}  // namespace rubatlas::modes
