#include "mpi/worker.hpp"

#include "mpi/session.hpp"
#include "mpi/signals.hpp"

namespace rubatlas::mpi {
namespace {

constexpr int kMaster = 0;

/// The master's next word, asleep until it comes.
Envelope wait_for_message(const Mailbox& mailbox) {
  Nap nap;
  while (true) {
    if (const auto envelope = mailbox.peek()) return *envelope;
    nap.take();
  }
}

}  // namespace

void work(const Mailbox& mailbox, PointRunner& runner) {
  const PointRunner::Callbacks callbacks{
      .between_revolutions = [] {},
      .after_point =
          [&](const PointReport& report) {
            PointReport message = report;
            message.stop_requested = stop_requested() ? 1 : 0;
            mailbox.send(kMaster, Tag::report, message);
          },
      // While a piece is computed the only message that can come is `stop`; it stays in the box until the
      // piece is given up, and is taken below.
      .stop = [&] { return stop_requested() || mailbox.peek().has_value(); },
  };
  const auto say_ready = [&] {
    const bool stop = stop_requested();
    mailbox.send(kMaster, Tag::ready, Ready{static_cast<std::uint8_t>(stop ? 1 : 0)});
  };
  say_ready();
  while (true) {
    const Envelope envelope = wait_for_message(mailbox);
    switch (envelope.tag) {
      case Tag::piece:
        runner.run(mailbox.receive<Piece>(envelope), callbacks);
        say_ready();
        break;
      case Tag::leave:
        mailbox.discard(envelope);
        return;
      default:
        mailbox.discard(envelope);
        break;
    }
  }
}

}  // namespace rubatlas::mpi
