// P16 (MODEL 6.3): the paper's Fig. 2, from the closed form of the blade (MODEL 3.2), without any motion.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/paper/findings_along.hpp"
#include "analysis/paper/statements.hpp"
#include "blade/elastica.hpp"

namespace rubatlas::analysis {
namespace {

constexpr double kPapersEulerLoad = 42.0;  ///< [N], to three digits
constexpr double kSmallLoad = 0.05;        ///< of the Euler load: "small F" means loads up to this one
/// "Linear" and "quadratic": the exponent of the growth over the last halving of a small load is within this
/// of 1 and 2.
constexpr double kExponent = 0.1;

/// The equilibrium at a load F L²/EI, on the rising branch from no load (MODEL 3.2): the load grows with the
/// bending parameter there, so that bisection finds it.
blade::Equilibrium<long double> at_load(double friction, double load) {
  long double low = 0.0L;
  long double high = 1.0L;
  constexpr int kHalvings = 200;
  for (int i = 0; i < kHalvings; ++i) {
    const auto middle = 0.5L * (low + high);
    (blade::equilibrium(friction, middle).load < load ? low : high) = middle;
  }
  return blade::equilibrium(friction, high);
}

}  // namespace

Statement judge_blade_curve(const Evidence& evidence) {
  Statement statement{"P16", {}};
  const auto& blades = evidence.rotor().scene.blades;
  if (!evidence.other_rotor().empty()) {
    statement.findings.push_back(not_covered(evidence.other_rotor()));
    return statement;
  }
  if (evidence.scene().contact.law != settings::ContactLaw::elastica) {
    statement.findings.push_back(not_covered("rigid blades have no curve"));
    return statement;
  }
  const double rigidity = blades.youngs_modulus * blades.width * std::pow(blades.thickness, 3) / 12.0;
  const double unit = rigidity / (blades.length * blades.length);  // the force that F L²/EI counts [N]
  const double euler = std::numbers::pi * std::numbers::pi / 4.0;
  statement.findings.push_back({std::abs(unit * euler - kPapersEulerLoad) < 0.05,
                                fmt::format("Euler load {:.2f} N", unit * euler), "Euler load 42.0 N",
                                fmt::format("{:.2f} N", unit * euler)});
  const double friction = evidence.friction();
  if (friction <= 0.0) {
    statement.findings.push_back(
        not_covered("a column without friction stands straight up to the Euler load"));
    return statement;
  }
  const double load = kSmallLoad * euler;
  const auto whole = at_load(friction, load);
  const auto half = at_load(friction, 0.5 * load);
  const auto shortening = static_cast<double>(std::log2(whole.shortening / half.shortening));
  const auto deflection = static_cast<double>(std::log2(whole.deflection / half.deflection));
  const auto text = [&](const char* what, double exponent, long double there) {
    return fmt::format("{} grows as F^{:.3f} from {:.2f} to {:.2f} N, where it is {:.3g} mm (μ = {:g})", what,
                       exponent, 0.5 * unit * load, unit * load,
                       1e3 * blades.length * static_cast<double>(there), friction);
  };
  statement.findings.push_back({std::abs(shortening - 2.0) <= kExponent,
                                text("δ", shortening, whole.shortening), "δ quadratic at small F",
                                fmt::format("F^{:.2f}", shortening)});
  statement.findings.push_back({std::abs(deflection - 1.0) <= kExponent,
                                text("Δ", deflection, whole.deflection), "Δ linear at small F",
                                fmt::format("F^{:.2f}", deflection)});
  return statement;
}

}  // namespace rubatlas::analysis
