/// The values of an axis that a scene gives by its ends.
#pragma once

#include <vector>

namespace rubatlas::settings {

/// `count` >= 2 values, value i the double nearest to from + i (to − from)/(count − 1), where `from` and `to`
/// are the shortest decimals that read back as these doubles: 0.05 to 0.95 in 19 values contains exactly the
/// double that a user means by 0.1. The last value is `to`.
std::vector<double> evenly_spaced(double from, double to, int count);

}  // namespace rubatlas::settings
