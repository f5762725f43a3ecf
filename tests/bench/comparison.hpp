/// What has been measured of each competitor, and the tables made of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy.hpp"
#include "peer.hpp"

namespace rubatlas::bench {

/// A peer as it takes part: with a step limit and the tolerance that matches the accuracy asked for.
struct Competitor {
  std::shared_ptr<const Peer> peer;
  PeerSettings settings;
  Accuracy accuracy;
  std::vector<std::uint64_t> touchdowns;   ///< [speed] in the compared revolutions
  std::vector<PeerRun> runs;               ///< [speed] as timed
  std::vector<std::vector<double>> times;  ///< [speed][repeat], CPU time of a run [s]
  int revolutions = 0;                     ///< of a timed run
};

struct Comparison {
  std::vector<double> speed_ratios;
  double target = 0.0;                   ///< typical error that all have to reach, in units of the clearance
  std::vector<Competitor> competitors;   ///< `hybrid`, `collocation`, that at `target`, and peers
  std::vector<Competitor> longer_steps;  ///< the same peers with longer step limits
  std::vector<Competitor> paper;         ///< the published scheme, and hybrid as accurate as that, in turn
  std::array<Competitor, 2> whole_points;  ///< `hybrid`, `collocation`: all 300 revolutions
  std::vector<Competitor> without_limit;   ///< the same peers with error control alone; not timed
};

/// CPU time of a revolution at one of the speeds [s]: median over the repeats.
double time_per_revolution(const Competitor& competitor, std::size_t speed);
/// Mean over the speeds [s].
double time_per_revolution(const Competitor& competitor);

/// Its time does not depend on a step limit.
bool is_own(const Competitor& competitor);

/// Touch-downs that a competitor finds where hybrid finds some: more at one speed do not make up for fewer at
/// another.
std::uint64_t found_touchdowns(const Competitor& competitor, const Competitor& hybrid);
std::string step_limit(const Competitor& competitor);

/// The goals, each with its measured figure, as a markdown table.
std::string goals(const Comparison& comparison);

/// All tables as markdown.
std::string tables(const Comparison& comparison);

}  // namespace rubatlas::bench
