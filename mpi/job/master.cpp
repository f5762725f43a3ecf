#include "mpi/job/master.hpp"

#include <algorithm>
#include <utility>

#include "mpi/clock.hpp"
#include "mpi/job/signals.hpp"

namespace rubatlas::mpi {
namespace {

constexpr std::size_t kSelf = 0;

}  // namespace

Master::Master(const Session& session, const Mailbox& mailbox, Schedule& schedule, PointRunner& runner,
               Reports reports, const Standing& standing)
    : mailbox_(mailbox),
      schedule_(schedule),
      runner_(runner),
      reports_(std::move(reports)),
      workers_(session.size() - 1),
      start_(std::chrono::steady_clock::now()) {
  result_.standing = standing;
  const auto ranks = static_cast<std::size_t>(session.size());
  result_.points_of_rank.assign(ranks, 0);
  result_.times_of_rank.resize(ranks);
  ranks_.assign(ranks, RankState::not_heard_of);
  ranks_[kSelf] = RankState::free;
}

JobResult Master::run() {
  const PointRunner::Callbacks callbacks{
      .go_on =
          [this] {
            serve();
            return !stopping_;
          },
      .after_points = [this](const Report& report) { take(kSelf, report); },
  };
  Nap nap;
  while (true) {
    serve();
    if (runner_.has_assignment()) {
      runner_.run(callbacks);
      ranks_[kSelf] = RankState::free;
      nap.reset();
      continue;
    }
    if (workers_ == 0) break;
    runner_.idle();
    nap.take();
  }
  return so_far();
}

void Master::serve() {
  while (const auto envelope = mailbox_.peek()) {
    if (envelope->tag == Tag::report) {
      take(static_cast<std::size_t>(envelope->source), mailbox_.receive<Report>(*envelope));
    } else {
      const auto ready = mailbox_.receive<Ready>(*envelope);
      ranks_[static_cast<std::size_t>(envelope->source)] = RankState::free;
      if (ready.stop_requested != 0 && !stopping_) stop();
    }
  }
  if (stop_requested() && !stopping_) stop();
  hand_out();
  if (reports_.progress.is_due()) reports_.progress.show(standing());
  if (record_pace_.is_due()) reports_.keep_record(so_far());
}

void Master::take(std::size_t rank, const Report& report) {
  for (std::size_t number = 0; number < report.count; ++number) {
    const auto outcome = schedule_.record(report.point(number));
    for (const auto& ending : outcome.finished) {
      result_.standing.count(ending.status);
      if (ending.detail != ending::StatusDetail::none) ++result_.ended_by[ending.detail];
    }
    result_.standing.computed += outcome.finished.size();
    for (const auto& decision : outcome.decisions) send(decision);
  }
  result_.points_of_rank[rank] += report.count;
  result_.times_of_rank[rank] = report.times;
  result_.work += report.work;
  if (report.stop_requested != 0 && !stopping_) stop();
}

void Master::send(const Schedule::Decision& decision) {
  for (const int holder : decision.ranks) {
    if (holder == static_cast<int>(kSelf)) {
      runner_.take(decision.verdict);
    } else {
      mailbox_.send(holder, Tag::verdict, decision.verdict);
    }
  }
}

void Master::stop() {
  stopping_ = true;
  reports_.progress.announce(reports_.how_to_go_on);
  reports_.keep_record(so_far());
  for (std::size_t rank = 1; rank < ranks_.size(); ++rank) {
    if (ranks_[rank] != RankState::has_left) mailbox_.send(static_cast<int>(rank), Tag::stop);
  }
}

/// Hands assignments to free ranks, and dismisses workers when there will be no further assignments.
void Master::hand_out() {
  for (std::size_t number = 0; !stopping_ && number < ranks_.size(); ++number) {
    if (ranks_[number] != RankState::free) continue;
    const auto assignment = schedule_.next(static_cast<int>(number));
    if (!assignment) break;
    ranks_[number] = RankState::computing;
    if (number == kSelf) {
      runner_.begin(*assignment);
    } else {
      mailbox_.send(static_cast<int>(number), Tag::assignment, *assignment);
    }
  }
  if (stopping_ || !schedule_.has_more()) dismiss_workers();
}

void Master::dismiss_workers() {
  const auto is_idle = [](RankState rank) { return rank == RankState::free || rank == RankState::has_left; };
  // While a job is stopping, a last report of one rank may decide about rows that another rank holds.
  if (stopping_ && !std::ranges::all_of(ranks_, is_idle)) return;
  for (std::size_t number = 1; number < ranks_.size(); ++number) {
    if (ranks_[number] != RankState::free) continue;
    mailbox_.send(static_cast<int>(number), Tag::leave);
    ranks_[number] = RankState::has_left;
    --workers_;
  }
}

JobResult Master::so_far() const {
  JobResult result = result_;
  result.standing = standing();
  return result;
}

Standing Master::standing() const {
  Standing now = result_.standing;
  now.seconds = seconds_since(start_);
  if (schedule_.recorded() > 0.0) now.seconds_left = now.seconds * schedule_.remaining_over_recorded();
  return now;
}

}  // namespace rubatlas::mpi
