/// The next interval of a contact, as far as it can be told from the one before: where its arc leads, and how
/// long it may be.
///
/// In the plane (τ/T, p) the arc goes on as a circle, with the direction and the curvature with which the
/// interval before has ended. T is chosen such that the whole contact is roughly a half circle.
#pragma once

#include <array>
#include <complex>
#include <limits>

#include "collocation/blades_in_contact.hpp"
#include "collocation/interval.hpp"
#include "collocation/law.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::collocation {

class Predictor {
 public:
  static constexpr double kOrder = 9.0;  ///< with the length, of the error between the nodes
  static constexpr double kUnknownError = std::numeric_limits<double>::infinity();

  /// Both must outlive the predictor.
  Predictor(const rotor::Machine& machine, const Law& law) : machine_(&machine), law_(&law) {}

  /// Where a blade takes the lead.
  struct Start {
    Touch touch;
    const BladeStart& blade;
    rotor::ShaftAndRing bodies;
    TipPlace at;                        ///< of the blade
    contact::BladeDirection direction;  ///< er
    Bending bending;
    rotor::Acceleration acceleration;
    bool is_lone;  ///< an elastic blade under an axial load, and no other touches
  };
  void begin(const Start& start);
  /// How long a contact that has just begun lasts, roughly [τ].
  [[nodiscard]] double duration() const { return duration_; }

  void begin_interval() { shortest_ = kShortest * length_; }
  /// The next trial is as long as the first one of this interval.
  void begin_again() { length_ = shortest_ / kShortest; }
  /// The interval may be much shorter than usual.
  void allow_shorter() { shortest_ *= kStillShorter; }
  /// The first guess of the next interval, whose start is known.
  void guess(Interval& next);
  /// An earlier contact is followed instead, by an arc of this length.
  void follow(double length) { length_of_trial_ = length; }
  [[nodiscard]] double length_of_trial() const { return length_of_trial_; }
  /// The trial has an error of so many times what is allowed. `first`: the trial, where it is the first of
  /// its contact, and has been guessed.
  void accepts(double error, const Interval* first);
  /// Likewise, and the next trial is to be shorter. False where it would be too short.
  bool shortens(double error);

  /// sin² of the angle between an interval's chord and its curve, where it ends.
  [[nodiscard]] double steepness(const Interval& interval) const;

  /// To the end of the interval that has been made.
  void goes_on(const Interval& interval);

 private:
  static constexpr double kShortest = 1e-8;      ///< of the arc with which an interval is begun
  static constexpr double kStillShorter = 1e-5;  ///< of that, where nothing else helps

  void begin_under_load(const Start& start, double half);
  [[nodiscard]] double length_by_error(double error) const;
  [[nodiscard]] double unit_at_rest(double time, double argument, double lean) const;
  void begin_unloaded(const Start& start, double half, double rate, double curvature_of_gap);

  const rotor::Machine* machine_;
  const Law* law_;
  double duration_ = 1.0;
  double time_unit_ = 1.0;         ///< T
  bool rests_ = false;             ///< the leading blade is elastic, and its tip at rest
  double longest_unit_ = 1.0;      ///< of T in that case
  Interval::Direction tangent_{};  ///< where the next interval starts, in the plane (τ/T, p), of length 1
  double curvature_ = 0.0;         ///< there, in the plane (τ/T, p)
  double unit_length_ = 1.0;       ///< of the first arc: the largest bending to be expected
  /// Length of the first arc against that unit, as the contacts of this motion have had it so far: of
  /// contacts that start unloaded, and under load.
  std::array<double, 2> share_of_first_{0.5, 1.0};
  bool is_lone_ = false;          ///< `Start::is_lone`
  double length_ = 1.0;           ///< of the next arc in that plane
  double length_of_trial_ = 1.0;  ///< of the present one
  double shortest_ = 0.0;
  Derivatives shaft_, ring_;  ///< there
  Course lean_;               ///< since the start of the next interval
};

}  // namespace rubatlas::collocation
