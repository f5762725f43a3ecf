#include "mpi/job/schedule.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rubatlas::mpi {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr auto kDone = static_cast<std::uint8_t>(ending::PointStatus::done);

/// Assignments become shorter when the points left are fewer than this many assignments of full length for
/// each rank.
constexpr std::size_t kAssignmentsPerRank = 32;
/// Runs are few when there are no more than this many for each rank. Then the longest goes first, so that
/// all end at the same time.
constexpr std::size_t kFewRuns = 4;

constexpr double kGoldenSection = 0.6180339887498949;  // its multiples are spread evenly

/// A number whose multiples, modulo `count`, take every value below `count`, and are spread evenly.
std::size_t spread_stride(std::size_t count) {
  auto stride = static_cast<std::size_t>(kGoldenSection * static_cast<double>(count));
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

}  // namespace

Schedule::Schedule(const plan::Grid& grid, const plan::Pieces& pieces, const Stored& stored, int rank_count)
    : grid_(grid),
      pieces_(pieces),
      chained_(grid.points_depend_on_each_other()),
      status_(stored.status.begin(), stored.status.end()),
      seam_(stored.seam.begin(), stored.seam.end()),
      final_state_(stored.final_state),
      runs_(grid.line_count() * pieces.per_line()),
      run_of_rank_(static_cast<std::size_t>(rank_count), kNone),
      costs_(grid.speed_count()),
      left_at_speed_(grid.speed_count(), 0) {
  for (std::size_t number = 0; number < runs_.size(); ++number) {
    Run& run = runs_[number];
    const std::size_t line = line_of(number);
    const std::size_t piece = piece_of(number);
    run.decided = piece == 0 || is_decided_in_atlas(line, piece);
    run.whole = !run.decided;
    if (!run.decided) ++undecided_;
    run.next = static_cast<std::uint32_t>(run.decided ? pieces_.begin(piece) : pieces_.run_begin(piece));
    skip_stored(number);
    for (std::size_t visit = run.next; visit < end_of(number); ++visit) {
      if (!run.whole && is_stored(line, visit)) continue;
      ++unassigned_;
      ++left_at_speed_[speed_index(line, visit)];
    }
    if (has_unassigned(number)) ++unfinished_runs_;
  }
  stride_ = spread_stride(grid.line_count());
  if (undecided_ == 0) return;
  Outcome nothing;
  for (std::size_t line = 0; line < grid.line_count(); ++line) {
    if (is_complete(run_of(line, 0))) advance(line, nothing);
  }
}

// --- what the atlas has ---

std::optional<motion::PointStart> Schedule::stored_end(std::size_t line, std::size_t visit) const {
  const std::size_t point = grid_.point(line, visit);
  if (status_[point] != kDone) return std::nullopt;
  return final_state_(point);
}

/// The first point of a piece that is not replaced has a mark in `/seam`. If it is there, its seam was
/// decided in an earlier run of the job.
bool Schedule::is_decided_in_atlas(std::size_t line, std::size_t piece) const {
  for (std::size_t visit = pieces_.begin(piece); visit < pieces_.end(piece); ++visit) {
    if (!is_stored(line, visit)) return false;
    if (seam_[grid_.point(line, visit)] != static_cast<std::uint8_t>(plan::Seam::repaired)) return true;
  }
  return true;
}

void Schedule::skip_stored(std::size_t number) {
  Run& run = runs_[number];
  if (run.whole) return;
  while (has_unassigned(number) && is_stored(line_of(number), run.next)) ++run.next;
}

// --- the choice of a run ---

std::optional<std::size_t> Schedule::choose_run(std::size_t& own) {
  if (unassigned_ == 0) return std::nullopt;
  const auto is_own = [&](std::size_t number) { return number < runs_.size() && is_free(number); };
  if (chained_) {
    if (!last_runs_ && unfinished_runs_ <= kFewRuns * run_of_rank_.size()) begin_endgame();
    if (last_runs_) return choose_longest();
  }
  if (own != kNone && is_own(own)) return own;
  if (own != kNone && chained_ && own + 1 < runs_.size() && line_of(own + 1) == line_of(own) &&
      !runs_[own + 1].taken && is_own(own + 1)) {
    return own = own + 1;
  }
  const auto is_passed = [&](std::size_t number) {
    return (chained_ && runs_[number].taken) || !has_unassigned(number);
  };
  while (first_open_ < runs_.size() && is_passed(in_order(first_open_))) ++first_open_;
  for (std::size_t place = first_open_; place < runs_.size(); ++place) {
    const std::size_t number = in_order(place);
    if (!is_passed(number) && is_free(number)) return own = number;
  }
  return std::nullopt;
}

void Schedule::begin_endgame() {
  last_runs_.emplace();
  for (std::size_t number = 0; number < runs_.size(); ++number) {
    if (!is_complete(number)) last_runs_->push_back(number);
  }
}

/// The free run with the longest time ahead.
std::optional<std::size_t> Schedule::choose_longest() {
  std::erase_if(*last_runs_, [&](std::size_t number) { return is_complete(number); });
  std::optional<std::size_t> longest;
  double most = -1.0;
  for (const std::size_t number : *last_runs_) {
    if (!is_free(number)) continue;
    const double ahead = remaining(number);
    if (ahead <= most) continue;
    most = ahead;
    longest = number;
  }
  return longest;
}

// --- assignments ---

std::optional<Assignment> Schedule::next(int rank) {
  if (!ready_.empty()) {
    const std::size_t run = ready_.front();
    ready_.pop_front();
    return assignment_at_seam(run);
  }
  std::size_t& own = run_of_rank_[static_cast<std::size_t>(rank)];
  const auto run = choose_run(own);
  if (!run) return std::nullopt;
  if (own == *run) runs_[own].taken = true;
  return assignment_of_run(*run, rank);
}

std::size_t Schedule::assignment_length() const {
  return std::clamp(unassigned_ / (kAssignmentsPerRank * run_of_rank_.size()), std::size_t{1},
                    Assignment::kMostPoints);
}

Keep Schedule::keep_of(std::size_t run, std::size_t visit) const {
  if (visit < pieces_.begin(piece_of(run)) || is_stored(line_of(run), visit)) return Keep::never;
  return runs_[run].decided ? Keep::at_once : Keep::after_verdict;
}

namespace {

void set_start(Assignment& assignment, const std::optional<motion::PointStart>& start) {
  if (!start) return;
  assignment.start = start->state;
  assignment.memory = start->memory;
  assignment.from_initial = 0;
}

}  // namespace

/// Where the next assignment of a run starts; nothing: from `initial`.
std::optional<motion::PointStart> Schedule::start_of(std::size_t number) const {
  const std::size_t visit = runs_[number].next;
  if (!chained_ || visit == 0) return std::nullopt;
  const auto course = courses_.find(number);
  if (course != courses_.end() && course->second.last_visit == visit - 1) return course->second.last;
  if (runs_[number].whole) return std::nullopt;
  return stored_end(line_of(number), visit - 1);
}

Assignment Schedule::assignment_of_run(std::size_t number, int rank) {
  Run& run = runs_[number];
  Assignment assignment;
  assignment.line = line_of(number);
  assignment.run = number;
  assignment.first_visit = run.next;
  assignment.keep = keep_of(number, run.next);
  set_start(assignment, start_of(number));
  const std::size_t length = assignment_length();
  while (has_unassigned(number) && assignment.count < length &&
         keep_of(number, run.next) == assignment.keep) {
    ++assignment.count;
    ++run.next;
  }
  run.out += static_cast<std::uint32_t>(assignment.count);
  unassigned_ -= assignment.count;
  skip_stored(number);
  if (chained_) {
    const auto [course, begins] = courses_.try_emplace(number);
    if (begins) course->second.first_visit = assignment.first_visit;
    if (assignment.keep == Keep::after_verdict) course->second.holders.insert(rank);
  }
  return assignment;
}

/// The point at which the front waits, or the first point of a run that the front has not reached.
Assignment Schedule::assignment_at_seam(std::size_t run) {
  const Course& course = courses_.at(run);
  const bool ahead = course.ahead == Ahead::under_way;
  const std::size_t begin = pieces_.begin(piece_of(run));
  Assignment assignment;
  assignment.line = line_of(run);
  assignment.run = run;
  assignment.first_visit = ahead ? begin : fronts_.at(assignment.line).visit;
  assignment.count = 1;
  assignment.keep = ahead ? Keep::compared : Keep::where_it_differs;
  assignment.found = course.found[assignment.first_visit - begin].trace;
  // The front may have passed the run before in the meantime.
  const auto before = courses_.find(run - 1);
  set_start(assignment,
            ahead && before != courses_.end() ? before->second.last : fronts_.at(assignment.line).start);
  return assignment;
}

// --- reports ---

Schedule::Outcome Schedule::record(const PointReport& report) {
  Outcome outcome;
  costs_.record(speed_index(report.line, report.visit), report.seconds);
  if (report.keep == Keep::compared) {
    courses_.at(report.run).ahead = report.same_motion != 0 ? Ahead::same : Ahead::different;
  } else if (report.keep == Keep::where_it_differs) {
    record_at_front(report, outcome);
  } else {
    record_of_run(report, outcome);
  }
  if (pieces_.per_line() > 1) advance(report.line, outcome);
  return outcome;
}

namespace {

std::optional<motion::PointStart> end_of_point(const PointReport& report) {
  if (report.status != ending::PointStatus::done) return std::nullopt;
  return motion::PointStart(report.final_state, report.final_memory);
}

}  // namespace

void Schedule::record_of_run(const PointReport& report, Outcome& outcome) {
  Run& run = runs_[report.run];
  --run.out;
  --left_at_speed_[speed_index(report.line, report.visit)];
  if (chained_) {
    Course& course = courses_.at(report.run);
    course.last_visit = report.visit;
    course.last = end_of_point(report);
    course.seconds += report.seconds;
    const std::size_t begin = pieces_.begin(piece_of(report.run));
    if (!run.decided && report.visit >= begin) {
      course.found.resize(end_of(report.run) - begin);
      course.found[report.visit - begin] = {true, report.keep, {report.status, report.detail}, report.trace};
      if (report.visit == begin) compare_ahead(report.run);
    }
  }
  if (run.decided && report.keep != Keep::never) outcome.finished.push_back({report.status, report.detail});
  if (!is_complete(report.run)) return;
  --unfinished_runs_;
  if (pieces_.per_line() == 1) courses_.erase(report.run);
  if (piece_of(report.run) + 1 < pieces_.per_line()) compare_ahead(report.run + 1);
}

void Schedule::compare_ahead(std::size_t number) {
  const auto course = courses_.find(number);
  const bool found = course != courses_.end() && !course->second.found.empty() &&
                     course->second.found.front().keep == Keep::after_verdict;
  if (!found || runs_[number - 1].decided || !is_complete(number - 1)) return;
  course->second.ahead = Ahead::under_way;
  ready_.push_back(number);
}

void Schedule::record_at_front(const PointReport& report, Outcome& outcome) {
  Front& front = fronts_.at(report.line);
  front.waits = false;
  if (report.same_motion != 0) {
    decide(report.run, report.visit, outcome);
    return;
  }
  outcome.finished.push_back({report.status, report.detail});
  status_[grid_.point(report.line, report.visit)] = static_cast<std::uint8_t>(report.status);
  front.start = end_of_point(report);
  front.behind_run = false;
  ++front.visit;
}

/// Moves the front of a line on, as far as it can go without another point.
void Schedule::advance(std::size_t line, Outcome& outcome) {
  Front& front = fronts_[line];
  while (front.piece < pieces_.per_line() && !front.waits) {
    const std::size_t run = run_of(line, front.piece);
    const std::size_t end = pieces_.end(front.piece);
    if (front.visit == end && !runs_[run].decided) decide(run, end, outcome);
    if (front.visit < end && runs_[run].decided) {
      if (!is_complete(run)) return;
      if (front.piece + 1 < pieces_.per_line() && !runs_[run + 1].decided) start_behind(run, front);
      front.visit = end;
    }
    if (front.visit == end) {
      if (!is_complete(run)) return;
      courses_.erase(run);
      ++front.piece;
      continue;
    }
    const std::size_t point = grid_.point(line, front.visit);
    if (status_[point] != 0) {  // what stands here was decided in an earlier run of the job
      if (seam_[point] == static_cast<std::uint8_t>(plan::Seam::repaired)) {
        front.start = stored_end(line, front.visit);
        front.behind_run = false;
        ++front.visit;
      } else {
        decide(run, front.visit, outcome);
      }
      continue;
    }
    const auto course = courses_.find(run);
    const std::size_t place = front.visit - pieces_.begin(front.piece);
    if (course == courses_.end() || place >= course->second.found.size() ||
        !course->second.found[place].there) {
      return;
    }
    if (course->second.ahead == Ahead::under_way) return;
    if (course->second.ahead == Ahead::same && front.behind_run) {
      decide(run, front.visit, outcome);
      continue;
    }
    front.waits = true;
    ready_.push_back(run);
  }
  if (front.piece == pieces_.per_line()) fronts_.erase(line);
}

/// The front goes on from the last point of a run that stands.
void Schedule::start_behind(std::size_t run, Front& front) const {
  const std::size_t last = end_of(run) - 1;
  const auto course = courses_.find(run);
  front.behind_run = course != courses_.end() && course->second.last_visit == last;
  front.start = front.behind_run ? course->second.last : stored_end(line_of(run), last);
}

/// The points of a run stand from a visit on.
void Schedule::decide(std::size_t number, std::size_t kept_from, Outcome& outcome) {
  runs_[number].decided = true;
  --undecided_;
  const auto course = courses_.find(number);
  if (course == courses_.end()) return;
  const std::size_t begin = pieces_.begin(piece_of(number));
  auto& found = course->second.found;
  auto& holders = course->second.holders;
  for (std::size_t place = kept_from - begin; place < found.size(); ++place) {
    if (found[place].keep == Keep::after_verdict) outcome.finished.push_back(found[place].ending);
  }
  if (!holders.empty()) {
    outcome.decisions.push_back(
        {{line_of(number), begin, kept_from, end_of(number)}, {holders.begin(), holders.end()}});
  }
  found.clear();
  holders.clear();
}

// --- expected cost ---

std::size_t Schedule::speed_index(std::size_t line, std::size_t visit) const {
  return grid_.direction(line) == plan::Direction::up ? visit : grid_.speed_count() - 1 - visit;
}

double Schedule::expected(std::size_t line, std::size_t first_visit, std::size_t last_visit) const {
  if (grid_.direction(line) == plan::Direction::up) return costs_.expected(first_visit, last_visit);
  return costs_.expected(grid_.speed_count() - last_visit, grid_.speed_count() - first_visit);
}

/// A run that has cost more than other lines did goes on so. One that has cost less may not have come yet to
/// what costs most.
double Schedule::remaining(std::size_t number) const {
  const Run& run = runs_[number];
  const std::size_t line = line_of(number);
  const double left = expected(line, run.next - run.out, end_of(number));
  const auto course = courses_.find(number);
  if (course == courses_.end() || !course->second.last_visit) return left;
  const double so_far = expected(line, course->second.first_visit, *course->second.last_visit + 1);
  return so_far > 0.0 ? left * std::max(1.0, course->second.seconds / so_far) : left;
}

double Schedule::remaining_over_recorded() const {
  if (!(costs_.recorded() > 0.0)) return 0.0;
  double left = 0.0;
  for (std::size_t i = 0; i < left_at_speed_.size(); ++i) {
    if (left_at_speed_[i] > 0) left += static_cast<double>(left_at_speed_[i]) * costs_.expected(i, i + 1);
  }
  // Runs under way are known better than by their speeds alone.
  for (const auto& [number, course] : courses_) {
    const Run& run = runs_[number];
    left += remaining(number) - expected(line_of(number), run.next - run.out, end_of(number));
  }
  const double point = costs_.expected(0, grid_.speed_count()) / static_cast<double>(grid_.speed_count());
  return (left + static_cast<double>(undecided_) * point) / costs_.recorded();
}

}  // namespace rubatlas::mpi
