// How accurate an interval is, between its nodes and at its end, as the Legendre coefficients of its
// acceleration fall. Orders and factors come from experiments (`tests/collocation`).

#include <algorithm>
#include <cmath>

#include "collocation/contact_arc.hpp"

namespace rubatlas::collocation {
namespace {

constexpr double kShareOfSixth = 0.3;  ///< coefficients fall by a common factor; one alone may vanish
constexpr double kLargestIntegral = 0.5 / (2.0 * kNodes + 1.0);

/// The last coefficient.
double last_of(const AtNodes& coefficients) {
  return std::max(coefficients[7], kShareOfSixth * coefficients[6]);
}
/// How much a coefficient is less than the one before.
double fall_of(const AtNodes& coefficients) {
  const double last = last_of(coefficients);
  return last > 0.0 ? std::sqrt(last / std::max(coefficients[5], last)) : 0.0;
}

}  // namespace

/// At the tolerance ε a factor times ε^(9/14) of the clearance: the motion goes on from the ends of
/// intervals, whose errors fall as about the fourteenth power of the length where those between the nodes
/// fall as the ninth. Whatever has to be accurate within an interval is solved for (`solved_at`).
double ContactArc::allowed_at(double tolerance, double clearance) {
  constexpr double kBetweenNodes = 0.27;
  constexpr double kOrderAtEnd = 14.0;
  return kBetweenNodes * clearance * std::pow(tolerance / clearance, Predictor::kOrder / kOrderAtEnd);
}

double ContactArc::allowed_between_nodes() const {
  constexpr double kOfLone = 2.0;
  return is_lone() ? kOfLone * allowed_ : allowed_;
}

/// Of a velocity: the first coefficient of the acceleration that eight nodes leave out, as the last ones
/// fall, times the largest value of the integral of its polynomial.
double ContactArc::error_between_nodes(const Interval& interval) {
  const double fall = fall_of(interval.coefficients);
  return std::max(interval.coefficients[7], kShareOfSixth * interval.coefficients[6] * fall) * fall *
         kLargestIntegral;
}

/// What quadrature leaves out at the end where a lone blade makes the force. Its coefficients fall unevenly:
/// the last five tell how much less the later ones are. Where the curve is steep against the chord over which
/// it is a graph those fall slowly, after earlier ones that do not show it. By these factors one contact in a
/// thousand errs by 3 tolerances.
double ContactArc::left_out_of_lone(const Interval& interval) const {
  constexpr double kShareOfFifth = 0.03;
  constexpr double kOfFive = 3.0;
  constexpr double kOfSteep = 3e-5;
  const AtNodes& coefficients = interval.coefficients;
  const double last = std::max(last_of(coefficients), kShareOfFifth * coefficients[5]);
  const double fall = last > 0.0 ? last / std::max(coefficients[3], last) : 0.0;
  const double of_five = kOfFive * last * (fall * fall);
  if (interval.chord.time == 0.0) return of_five;
  const double square = predictor_.steepness(interval);
  const double eighth = (square * square) * (square * square);
  return std::max(of_five, kOfSteep * coefficients[0] * (eighth * eighth));
}

/// Error of a velocity in what is allowed, between the nodes and at the end.
double ContactArc::error_of(const Interval& interval) const {
  const double last = last_of(interval.coefficients);
  const double fall = fall_of(interval.coefficients);
  // Quadrature leaves out the fifteenth coefficient at the end: much less, unless coefficients hardly fall.
  const double fall_by_four = (fall * fall) * (fall * fall);
  double left_out = last * fall_by_four * fall_by_four;
  // Of a load that makes the ring yield in its own time the ring keeps what is left out between the nodes.
  if (ring_keeps_load_) left_out = last * fall * fall;
  // Under friction with a velocity those of the force fall as slowly as those of the time, and the last ones
  // of both meet in their product.
  if (!law_->has_slip_state() && last > 0.0)
    left_out = std::max(left_out, last * last * fall / std::max(interval.coefficients[0], last));
  const auto at_end = [&](double coefficient) { return coefficient * kLargestIntegral / tolerance_; };
  double error = std::max(error_between_nodes(interval) / allowed_between_nodes(), at_end(left_out));
  // It falls twice as fast with the length as the error between the nodes.
  if (is_lone()) error = std::max(error, std::sqrt(at_end(left_out_of_lone(interval))));
  constexpr double kCareWithSeveral = 4.0;  // blades: coefficients fall less evenly
  if (interval.tips.size() > 1) error *= kCareWithSeveral;
  const double length = interval.elapsed.at_end() / machine_.longest_interval();
  return length > 1.0 ? std::max(error, std::pow(length, Predictor::kOrder)) : error;
}

}  // namespace rubatlas::collocation
