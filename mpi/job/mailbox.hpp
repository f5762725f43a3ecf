/// Sends and receives messages; never waits for one.
#pragma once

#include <chrono>
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "mpi/job/messages.hpp"
#include "mpi/job/session.hpp"

namespace rubatlas::mpi {

/// A message that has arrived and has not been received yet.
struct Envelope {
  int source = 0;
  Tag tag = Tag::ready;
};

class Mailbox {
 public:
  /// How often a rank that computes looks for messages. A look costs some microseconds, the clocks included.
  static constexpr std::chrono::microseconds kLookPeriod{500};

  explicit Mailbox(const Session& session) : parallel_(session.is_parallel()) {}

  template <typename Payload>
  requires std::is_trivially_copyable_v<Payload>
  void send(int rank, Tag tag, const Payload& payload) const {
    send_bytes(rank, tag, &payload, sent_size(payload));
  }
  void send(int rank, Tag tag) const { send(rank, tag, Nothing{}); }

  /// The next message from any rank, if one has arrived.
  [[nodiscard]] std::optional<Envelope> peek() const;

  template <typename Payload>
  requires std::is_trivially_copyable_v<Payload>
  [[nodiscard]] Payload receive(const Envelope& envelope) const {
    Payload payload{};
    receive_bytes(envelope, &payload, sizeof payload);
    return payload;
  }
  /// Receives a message without content: its tag says everything.
  void discard(const Envelope& envelope) const { static_cast<void>(receive<Nothing>(envelope)); }

 private:
  static void send_bytes(int rank, Tag tag, const void* payload, std::size_t size);
  static void receive_bytes(const Envelope& envelope, void* payload, std::size_t size);

  bool parallel_;
};

}  // namespace rubatlas::mpi
