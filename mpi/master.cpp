#include "mpi/master.hpp"

#include "mpi/clock.hpp"
#include "mpi/signals.hpp"

namespace rubatlas::mpi {
namespace {

constexpr int kSelf = 0;

/// A look into the mailbox costs about a microsecond; a revolution takes some ten.
constexpr std::chrono::microseconds kServicePeriod{50};

}  // namespace

Master::Master(const Session& session, const Mailbox& mailbox, Schedule& schedule, PointRunner& runner,
               Progress& progress, const Standing& standing)
    : mailbox_(mailbox),
      schedule_(schedule),
      runner_(runner),
      progress_(progress),
      start_(std::chrono::steady_clock::now()),
      next_service_(start_) {
  result_.standing = standing;
  const auto ranks = static_cast<std::size_t>(session.size());
  result_.points_of_rank.assign(ranks, 0);
  result_.busy_seconds_of_rank.assign(ranks, 0.0);
  for (int rank = 1; rank < session.size(); ++rank) workers_.insert(rank);
}

JobResult Master::run() {
  const PointRunner::Callbacks callbacks{
      .between_revolutions = [this] { serve_when_due(); },
      .after_point = [this](const PointReport& report) { take(kSelf, report); },
      .stop = [this] { return stopping_; },
  };
  Nap nap;
  while (true) {
    serve();
    const auto piece = stopping_ ? std::nullopt : schedule_.next(kSelf);
    if (piece) {
      runner_.run(*piece, callbacks);
      nap.reset();
      continue;
    }
    if (workers_.empty()) break;
    nap.take();
  }
  result_.stopped = stopping_ && result_.standing.finished < result_.standing.total;
  result_.standing = standing();
  return result_;
}

void Master::serve_when_due() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_service_) return;
  next_service_ = now + kServicePeriod;
  serve();
}

void Master::serve() {
  while (const auto envelope = mailbox_.peek()) {
    if (envelope->tag == Tag::report) {
      take(envelope->source, mailbox_.receive<PointReport>(*envelope));
    } else {
      const bool stop = mailbox_.receive<Ready>(*envelope).stop_requested != 0;
      idle_.push_back(envelope->source);
      if (stop && !stopping_) stop_workers();
    }
  }
  if (stop_requested() && !stopping_) stop_workers();
  hand_out();
  if (progress_.is_due()) progress_.show(standing());
}

void Master::take(int rank, const PointReport& report) {
  schedule_.record(report);
  ++result_.standing.finished;
  ++result_.standing.computed;
  if (report.status != solve::PointStatus::done) ++result_.standing.failed;
  ++result_.points_of_rank[static_cast<std::size_t>(rank)];
  result_.busy_seconds_of_rank[static_cast<std::size_t>(rank)] += report.seconds;
  result_.work += report.work;
  if (report.stop_requested != 0 && !stopping_) stop_workers();
}

void Master::stop_workers() {
  stopping_ = true;
  for (const int rank : workers_) mailbox_.send(rank, Tag::stop);
}

/// Idle workers get a piece; they leave when there will be none.
void Master::hand_out() {
  std::vector<int> still_idle;
  for (const int rank : idle_) {
    const auto piece = stopping_ ? std::nullopt : schedule_.next(rank);
    if (piece) {
      mailbox_.send(rank, Tag::piece, *piece);
    } else if (stopping_ || schedule_.unassigned() == 0) {
      mailbox_.send(rank, Tag::leave);
      workers_.erase(rank);
    } else {
      still_idle.push_back(rank);
    }
  }
  idle_ = std::move(still_idle);
}

Standing Master::standing() const {
  Standing now = result_.standing;
  now.seconds = seconds_since(start_);
  if (now.computed > 0) now.seconds_left = now.seconds * schedule_.remaining_over_recorded();
  return now;
}

}  // namespace rubatlas::mpi
