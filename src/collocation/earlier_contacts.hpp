/// The last contacts of a motion, as first guesses for those that begin alike: a motion that is periodic, or
/// nearly so, meets the ring again and again in the same way, and one that whirls does so all around the
/// ring. Contacts are therefore compared as seen from the blade that begins them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <deque>

#include "collocation/interval.hpp"

namespace rubatlas::collocation {

/// How a contact begins, along and across the blade.
struct Beginning {
  Eigen::Array4d shaft;        ///< place from the centre of the ring at rest, and velocity
  Eigen::Array4d ring;         ///< place and velocity
  double angular_speed = 0.0;  ///< φ' [rad per unit τ]
  Eigen::Array2d forcing;      ///< acceleration by all forcings [m per unit τ²]
  double argument = 0.0;       ///< p
  double slip = 0.0;           ///< s
  bool straight = false;       ///< as in `TipStart`
};

/// The solution of an interval of an earlier contact.
struct EarlierInterval {
  double length = 0.0;  ///< of its arc in the plane (τ/T, p)
  Interval::Direction chord{};
  Interval::Direction normal{};
  std::array<double, 2> blade{};  ///< er where it starts
  double start_lean = 0.0;        ///< l
  AtNodes deviation, elapsed, lean;
  Places shaft, ring;

  void take(const Machine& machine, const Interval& solved, double length_of_arc);
  /// Guesses an interval whose start is known: it goes on from there as this one did.
  void guess(const Machine& machine, Interval& next) const;
};

struct EarlierContact {
  static constexpr std::size_t kMostIntervals = 8;
  std::size_t count = 0;  ///< of intervals that are kept
  std::array<EarlierInterval, kMostIntervals> intervals;
};

class EarlierContacts {
 public:
  /// `clearance`: what differences of places are measured with [m].
  EarlierContacts(bool ring_moves, double clearance) : ring_moves_(ring_moves), clearance_(clearance) {}

  struct Found {
    const EarlierContact* alike = nullptr;  ///< that began most alike; null where none began nearly so
    EarlierContact* kept = nullptr;         ///< where the new contact is to be kept; may be the same
  };
  /// For a contact that begins now.
  Found find(const Beginning& beginning);

 private:
  /// Infinite where it is not below `least`.
  [[nodiscard]] double distance(const Beginning& a, const Beginning& b, double least) const;

  static constexpr std::size_t kKept = 64;
  static constexpr std::size_t kAtOnce = 8;  ///< are compared
  bool ring_moves_;
  double clearance_;
  std::array<Beginning, kKept> beginnings_;
  using OfAll = Eigen::Array<double, kKept, 1>;
  OfAll across_ = OfAll::Zero(), velocity_across_ = OfAll::Zero();  ///< of their shafts
  std::deque<EarlierContact> contacts_;  ///< made as they are needed: most motions have a few kinds
  std::size_t oldest_ = 0;
};

}  // namespace rubatlas::collocation
