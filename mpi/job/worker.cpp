#include "mpi/job/worker.hpp"

#include "mpi/job/session.hpp"
#include "mpi/job/signals.hpp"

namespace rubatlas::mpi {
namespace {

constexpr int kMaster = 0;

/// Messages from the master, and the answers to them.
class Ear {
 public:
  Ear(const Mailbox& mailbox, PointRunner& runner) : mailbox_(mailbox), runner_(runner) {}

  /// Receives all messages that have arrived.
  void listen() {
    while (const auto envelope = mailbox_.peek()) {
      if (envelope->tag == Tag::assignment) {
        runner_.begin(mailbox_.receive<Assignment>(*envelope));
        continue;
      }
      if (envelope->tag == Tag::verdict) {
        runner_.take(mailbox_.receive<Verdict>(*envelope));
        continue;
      }
      mailbox_.discard(*envelope);
      stopping_ = stopping_ || envelope->tag == Tag::stop;
      leaving_ = leaving_ || envelope->tag == Tag::leave;
    }
  }
  [[nodiscard]] bool stopping() const { return stopping_ || stop_requested(); }
  [[nodiscard]] bool leaving() const { return leaving_; }

  void say_ready() const {
    mailbox_.send(kMaster, Tag::ready, Ready{static_cast<std::uint8_t>(stop_requested() ? 1 : 0)});
  }

 private:
  const Mailbox& mailbox_;
  PointRunner& runner_;
  bool stopping_ = false;
  bool leaving_ = false;
};

}  // namespace

void work(const Mailbox& mailbox, PointRunner& runner) {
  Ear ear(mailbox, runner);
  const PointRunner::Callbacks callbacks{
      .go_on =
          [&] {
            ear.listen();
            return !ear.stopping();
          },
      .after_points =
          [&](const Report& report) {
            Report message = report;
            message.stop_requested = stop_requested() ? 1 : 0;
            mailbox.send(kMaster, Tag::report, message);
          },
  };
  ear.say_ready();
  Nap nap;
  while (!ear.leaving()) {
    ear.listen();
    if (runner.has_assignment()) {
      runner.run(callbacks);
      ear.say_ready();
      nap.reset();
    } else {
      runner.idle();
      nap.take();
    }
  }
}

}  // namespace rubatlas::mpi
