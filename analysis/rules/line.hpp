/// One line of an atlas as the rules need it: class and displacement of the motion along the speed ratio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Whether a blade touches the ring. The numbers are those of the flags in MAPS.h5.
enum class Contact : std::uint8_t { not_known = 0, none = 1, touches = 2 };

struct PointContact {
  Contact contact = Contact::not_known;
  /// Least distance between a tip and the ring [m] where nothing touches, or a lower bound of it while a free
  /// vibration has not died out; NaN where not known.
  double distance = kNotANumber;
};

/// All vectors have one entry per speed, ascending in Ω.
struct Line {
  std::vector<double> speed_ratio;               ///< Ω [-]
  std::vector<std::uint8_t> motion;              ///< class per revolution
  std::vector<std::uint8_t> motion_per_passing;  ///< class per blade passing; empty where the atlas has none
  std::vector<double> max_displacement;          ///< [m]; NaN where the point is not done
  std::vector<PointContact> contact{};           ///< empty where nothing is known of it

  [[nodiscard]] std::size_t size() const { return speed_ratio.size(); }
};

/// The rules speak of the scaled speed Ω n/3, at which the two triggers of n blades lie at 1/3 and 2/3.
class SpeedScale {
 public:
  explicit SpeedScale(int blade_count) : blades_(blade_count) {}
  [[nodiscard]] double scaled(double speed_ratio) const { return speed_ratio * blades_ / 3.0; }
  [[nodiscard]] double speed_ratio(double scaled) const { return scaled * 3.0 / blades_; }

 private:
  double blades_;
};

/// Whether a region or a trigger exists. The numbers are those of the flags in MAPS.h5.
enum class Presence : std::uint8_t {
  not_covered = 0,  ///< the line has no points in the range where it would be
  absent = 1,
  present = 2,
  merged = 3,  ///< region 4 only: region 2 extends through it
};

}  // namespace rubatlas::analysis
