/// The machine of a motion in the numbers that intervals are solved with, and what of it depends on time.
#pragma once

#include <complex>
#include <vector>

#include "collocation/interval.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::collocation {

class MachineInTime {
 public:
  /// The machine must outlive this. `ring_radius` R [m].
  MachineInTime(const rotor::Machine& machine, double ring_radius);

  [[nodiscard]] const Machine& numbers() const { return numbers_; }
  /// Longest interval whose directions are turned by series [τ].
  [[nodiscard]] double longest_interval() const { return longest_interval_; }
  /// Acceleration by all forcings at time τ of the revolution [m per unit τ²].
  [[nodiscard]] std::complex<double> forcing(double time) const;
  /// Sets what the forcings and the speed are where an interval starts.
  void start(Interval& interval) const;

 private:
  struct Term {
    double amplitude;  ///< [m per unit τ²]
    double phase;      ///< γ [rad]
    std::complex<double> at_zero = std::polar(amplitude, phase);
  };
  [[nodiscard]] std::complex<double> term(std::size_t number, double time) const {
    const auto& [amplitude, phase, at_zero] = terms_[number];
    const double frequency = numbers_.frequency[number];
    return frequency == 0.0 ? at_zero : std::polar(amplitude, frequency * time + phase);
  }

  const rotor::BladeSet* blades_;
  Machine numbers_;
  std::vector<Term> terms_;
  double longest_interval_;
};

}  // namespace rubatlas::collocation
