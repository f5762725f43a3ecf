/// The elastica of src/blade/elastica.cpp, computed in double precision.
///
/// A long double of WebAssembly has 128 bits and is computed in software, which made the table of a friction
/// coefficient take a third of a second. The formula has no cancellation: double precision leaves it a few
/// 1e-16 of relative error, and the table that is made of it 1e-13 as before. So that the formula stays
/// written once, its source is read again here with every `long double` a `double`.

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "blade/elastica.hpp"

#define long
#include "blade/elastica.cpp"  // equilibrium(double, double)
#undef long

namespace rubatlas::blade {

Equilibrium<long double> equilibrium(long double friction, long double bending) {
  const Equilibrium<double> at = equilibrium(static_cast<double>(friction), static_cast<double>(bending));
  return {at.load, at.shortening, at.deflection};
}

}  // namespace rubatlas::blade
