#include "mpi/job/master.hpp"

#include <algorithm>
#include <utility>

#include "mpi/clock.hpp"
#include "mpi/job/signals.hpp"

namespace rubatlas::mpi {
namespace {

constexpr int kSelf = 0;

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
  ranks_.resize(ranks);
  ranks_[kSelf].seats = runner.seats();
  for (int seat = 0; seat < runner.seats(); ++seat) ranks_[kSelf].free_seats.push_back(seat);
}

JobResult Master::run() {
  const PointRunner::Callbacks callbacks{
      .go_on =
          [this] {
            serve();
            return !stopping_;
          },
      .after_points = [this](const Report& report) { take(kSelf, report); },
      .piece_over =
          [this](int seat) {
            --ranks_[kSelf].pieces;
            seat_is_free(kSelf, seat);
            serve();
          },
  };
  Nap nap;
  while (true) {
    serve();
    if (runner_.pieces() > 0) {
      runner_.run(callbacks);
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
      take(envelope->source, mailbox_.receive<Report>(*envelope));
    } else {
      const auto ready = mailbox_.receive<Ready>(*envelope);
      Rank& rank = ranks_[static_cast<std::size_t>(envelope->source)];
      // The first messages of a rank are about seats that have had no piece yet.
      const bool greets = static_cast<int>(rank.free_seats.size()) + rank.pieces < ready.seats;
      rank.seats = ready.seats;
      if (!greets) --rank.pieces;
      seat_is_free(envelope->source, ready.seat);
      if (ready.stop_requested != 0 && !stopping_) stop();
    }
  }
  if (stop_requested() && !stopping_) stop();
  hand_out();
  if (reports_.progress.is_due()) reports_.progress.show(standing());
  if (record_pace_.is_due()) reports_.keep_record(so_far());
}

void Master::take(int rank, const Report& report) {
  for (std::size_t number = 0; number < report.count; ++number) {
    const auto outcome = schedule_.record(report.point(number));
    for (const auto& ending : outcome.finished) {
      result_.standing.count(ending.status);
      if (ending.detail != point::StatusDetail::none) ++result_.ended_by[ending.detail];
    }
    result_.standing.computed += outcome.finished.size();
    for (const auto& decision : outcome.decisions) send(decision);
  }
  const auto place = static_cast<std::size_t>(rank);
  result_.points_of_rank[place] += report.count;
  result_.times_of_rank[place] = report.times;
  result_.work += report.work;
  if (report.stop_requested != 0 && !stopping_) stop();
}

void Master::send(const Schedule::Decision& decision) {
  for (const int holder : decision.ranks) {
    if (holder == kSelf) {
      runner_.take(decision.verdict);
    } else {
      mailbox_.send(holder, Tag::verdict, decision.verdict);
    }
  }
}

void Master::seat_is_free(int rank, int seat) {
  ranks_[static_cast<std::size_t>(rank)].free_seats.push_back(seat);
}

void Master::stop() {
  stopping_ = true;
  reports_.progress.announce(reports_.how_to_go_on);
  reports_.keep_record(so_far());
  for (std::size_t rank = 1; rank < ranks_.size(); ++rank) {
    if (!ranks_[rank].has_left) mailbox_.send(static_cast<int>(rank), Tag::stop);
  }
}

/// Hands pieces to free seats, and dismisses workers when there will be no further pieces.
void Master::hand_out() {
  while (!stopping_ && schedule_.has_more()) {
    const int number = next_to_serve();
    if (number < 0) break;
    Rank& rank = ranks_[static_cast<std::size_t>(number)];
    const auto piece = schedule_.next(number, rank.free_seats.back());
    if (!piece) break;
    rank.free_seats.pop_back();
    ++rank.pieces;
    if (number == kSelf) {
      runner_.begin(*piece);
    } else {
      mailbox_.send(number, Tag::piece, *piece);
    }
  }
  if (stopping_ || !schedule_.has_more()) dismiss_workers();
}

/// The rank that gets the next piece: the rank with a free seat that computes the fewest pieces. The result
/// is −1 while every rank with a free seat already computes its share of the lines that are left; the pieces
/// then wait for other ranks. Lines are shared out evenly among the ranks, whatever their number of seats.
/// The remainder of this division goes to the ranks that ask first once all ranks have their share.
int Master::next_to_serve() const {
  const int all = static_cast<int>(schedule_.side_by_side());
  const int even_share = all / static_cast<int>(ranks_.size());
  const bool left_over = all % static_cast<int>(ranks_.size()) != 0;
  int chosen = -1;
  bool everybody_has_it = true;
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    const Rank& rank = ranks_[i];
    // A rank may have fewer seats than its share.
    const bool full = rank.seats > 0 && rank.pieces == rank.seats;
    everybody_has_it = everybody_has_it && (full || rank.pieces >= even_share);
    if (rank.free_seats.empty()) continue;
    if (chosen < 0 || rank.pieces < ranks_[static_cast<std::size_t>(chosen)].pieces) {
      chosen = static_cast<int>(i);
    }
  }
  if (chosen < 0) return chosen;
  const int pieces = ranks_[static_cast<std::size_t>(chosen)].pieces;
  const bool takes = pieces < even_share || (pieces == even_share && left_over && everybody_has_it);
  return takes ? chosen : -1;
}

void Master::dismiss_workers() {
  const auto is_idle = [](const Rank& rank) {
    return rank.seats > 0 && static_cast<int>(rank.free_seats.size()) == rank.seats;
  };
  // While a job is stopping, a last report of one rank may decide about rows that another rank holds.
  if (stopping_ && !std::ranges::all_of(ranks_, is_idle)) return;
  for (std::size_t number = 1; number < ranks_.size(); ++number) {
    Rank& rank = ranks_[number];
    if (!is_idle(rank) || rank.has_left) continue;
    mailbox_.send(static_cast<int>(number), Tag::leave);
    rank.has_left = true;
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
