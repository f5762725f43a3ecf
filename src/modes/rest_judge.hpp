/// Who judges which tips rest on the ring, and which slip.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "modes/open_contact.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class RestJudge {
 public:
  RestJudge() = default;
  RestJudge(const RestJudge&) = delete;
  RestJudge& operator=(const RestJudge&) = delete;
  virtual ~RestJudge() = default;

  using Tell = std::function<void(const OpenContact&)>;
  /// Frees the tips at rest that friction cannot hold in a state, and calls `tell` for each of them. False
  /// where a tip is left neither rest nor a direction of slip (MODEL 5).
  virtual bool settle(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
                      const Tell& tell) = 0;
  /// The slip velocity of a tip has come to zero: it rests or slips. False where it can do neither.
  virtual bool arrest(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
                      std::size_t contact) = 0;
  /// A tip at rest that friction no longer holds slips. False where it has no direction.
  virtual bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
                      std::size_t contact) = 0;
};

}  // namespace rubatlas::modes
