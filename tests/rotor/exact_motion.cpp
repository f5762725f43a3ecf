#include "exact_motion.hpp"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

namespace rubatlas::rotor {
namespace {

namespace mp = boost::multiprecision;
using Digits60 = mp::number<mp::cpp_bin_float<60>, mp::et_off>;

// Unknowns: displacement, velocity, and the two components of a unit vector that turns with the rotor.
using Matrix = std::array<std::array<Digits60, 4>, 4>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Digits60 sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a[i][k] * b[k][j];
      result[i][j] = sum;
    }
  }
  return result;
}

/// exp(matrix · time): a Taylor series over 2^-squarings of the time, then squared.
Matrix exponential(const Matrix& matrix, double time, double norm) {
  int squarings = 0;
  while (norm * time > std::ldexp(0.5, squarings)) ++squarings;
  const Digits60 step = mp::ldexp(Digits60(time), -squarings);
  Matrix term{};
  for (std::size_t i = 0; i < 4; ++i) term[i][i] = 1;
  Matrix sum = term;
  for (int k = 1; k <= 40; ++k) {
    term = product(term, matrix);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        term[i][j] *= step / k;
        sum[i][j] += term[i][j];
      }
    }
  }
  for (int k = 0; k < squarings; ++k) sum = product(sum, sum);
  return sum;
}

}  // namespace

Motion exact_motion(double damping_ratio, double speed_ratio, const Motion& start,
                    std::complex<double> forcing, double time) {
  const Digits60 zeta = damping_ratio;
  const Digits60 omega = speed_ratio;
  Matrix matrix{};
  matrix[0][1] = 1;
  matrix[1][0] = -1;
  matrix[1][1] = -2 * zeta;
  matrix[1][2] = 1;  // the forcing along the first component of the turning vector
  matrix[2][3] = -omega;
  matrix[3][2] = omega;
  const Matrix flow = exponential(matrix, time, 2.0 + 2.0 * damping_ratio + speed_ratio);
  // Re(a e^{iΩτ}) and Im(a e^{iΩτ}) are both first components of a vector that turns: started at (Re a, Im a)
  // and at (Im a, −Re a).
  const auto component = [&](double displacement, double velocity, double cosine, double sine,
                             std::size_t row) {
    return (flow[row][0] * displacement + flow[row][1] * velocity + flow[row][2] * cosine +
            flow[row][3] * sine)
        .convert_to<double>();
  };
  const auto both = [&](std::size_t row) {
    return std::complex<double>(
        component(start.position.real(), start.velocity.real(), forcing.real(), forcing.imag(), row),
        component(start.position.imag(), start.velocity.imag(), forcing.imag(), -forcing.real(), row));
  };
  return {both(0), both(1)};
}

}  // namespace rubatlas::rotor
