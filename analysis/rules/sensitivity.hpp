/// How each region and trigger changes as one parameter grows: the rows of the paper's Table 1, in sentences
/// made from the numbers with the thresholds below.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/rules/line.hpp"
#include "analysis/rules/line_summary.hpp"
#include "analysis/rules/parameter.hpp"

namespace rubatlas::analysis {

/// A region or a trigger with smaller changes than these is called unchanged. Widths and places are in scaled
/// speed.
constexpr double kNoticeableWidth =
    0.02;  ///< less than half a running window (regions.hpp): the rule's own doubt
constexpr double kNoticeablePlace = 0.01;   ///< a third of the stretch that a trigger is found with
constexpr double kNoticeableShare = 0.10;   ///< of aperiodic points
constexpr double kNoticeableChange = 0.10;  ///< of a width or displacement, relative

/// "region 2": "widens from …; merged with region 2 at ζ ≤ 0.02".
struct Effect {
  std::string subject;
  std::string text;
};

/// The changes along one parameter at fixed values of all others.
struct Sensitivity {
  std::size_t parameter = 0;         ///< index of the parameter that grows
  std::string fixed;                 ///< the other parameters: "μ = 0.1, me = 0 kg m"
  std::vector<std::size_t> lines{};  ///< ascending in the parameter
  std::vector<Effect> effects{};     ///< region 1, trigger 1, region 2, region 3, trigger 2, region 4
};

/// One entry per swept parameter and combination of the others; the direction of a sweep is no parameter that
/// grows. `lines` are all lines of the atlas, in its order.
std::vector<Sensitivity> sensitivities(std::span<const Parameter> parameters,
                                       std::span<const LineSummary> lines, SpeedScale scale);

}  // namespace rubatlas::analysis
