/// The largest force and strain of contacts of several blades, by both methods, against dense samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <utility>

#include "../support/hybrid_motion.hpp"
#include "several_blades.hpp"

namespace rubatlas::test {
namespace {

constexpr std::array kLoads{trajectory::Load::normal_force, trajectory::Load::root_strain};

/// Compares what each piece says of its largest load with samples of the load.
class LoadsOfPieces final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) look_at(piece, contact);
    with_several_ |= piece.contact_count() > 1;
  }
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::lift_off && std::exchange(with_several_, false)) ++contacts;
  }

  int contacts = 0;  ///< that have ended since several blades have touched at a time
  /// By how much a largest load was smaller than a sample, at most, of the largest sample before.
  double too_small = 0.0;
  /// Of the whole motion, as an observable finds them and as samples have it.
  std::array<double, 2> largest{};
  std::array<double, 2> sampled{};

 private:
  void look_at(trajectory::MotionPiece& piece, std::size_t contact) {
    constexpr int kSamples = 24;
    std::array<double, 2> found{};
    for (std::size_t i = 0; i < kLoads.size(); ++i) {
      // In this order, since a piece may keep what it has found.
      largest[i] = std::max(largest[i], piece.largest(kLoads[i], contact, largest[i]).value);
      found[i] = piece.largest(kLoads[i], contact, 0.0).value;
    }
    for (int k = 0; k <= kSamples; ++k) {
      const double share = static_cast<double>(k) / kSamples;
      const double time = k == kSamples ? piece.end() : piece.begin() + share * (piece.end() - piece.begin());
      const trajectory::ContactForce there = piece.contact_force(contact, time);
      for (std::size_t i = 0; i < kLoads.size(); ++i) {
        const double value = kLoads[i] == trajectory::Load::normal_force ? there.normal : there.root_strain;
        sampled[i] = std::max(sampled[i], value);
        too_small = std::max(too_small, (value - found[i]) / sampled[i]);
      }
    }
  }
  bool with_several_ = false;
};

void expect_no_sample_above_the_largest_load(int least_contacts) {
  for (const bool collocated : {false, true}) {
    std::mt19937_64 generator(7);
    int contacts = 0;
    for (int rotors = 0; contacts < least_contacts; ++rotors) {
      const Rotor rotor = random_rotor(generator);
      const rotor::State start = random_start(generator);
      const modes::ContactLimits limits{1e-9 * kClearanceOfSeveral, 0.5};
      const auto motion = collocated
                              ? collocation_motion(rotor.constants, rotor.blades.count(), rotor.law, limits)
                              : hybrid_motion(rotor.constants, rotor.blades, rotor.law, kNoForcing, limits);
      LoadsOfPieces loads;
      auto status = test::start(*motion, start);
      for (int i = 0; i < 20 && status == ending::PointStatus::done; ++i) status = revolve(*motion, loads);
      contacts += loads.contacts;
      SCOPED_TRACE(::testing::Message() << (collocated ? "collocation" : "hybrid") << ", rotor " << rotors);
      // Each sample is solved for by itself, and errs by the tolerance's share of a load.
      constexpr double kErrorOfSample = 1e-6;
      EXPECT_LE(loads.too_small, kErrorOfSample);
      for (std::size_t i = 0; i < kLoads.size(); ++i)
        EXPECT_GE(loads.largest[i], loads.sampled[i] * (1.0 - kErrorOfSample));
    }
  }
}

TEST(LargestLoads, OfContactsOfSeveralBladesAreNotSmallerThanAnySampleOfThem) {
  expect_no_sample_above_the_largest_load(400);
}
TEST(LargestLoadsSlow, OfTenThousandContactsOfSeveralBladesAreNotSmallerThanAnySampleOfThem) {
  expect_no_sample_above_the_largest_load(10'000);
}

}  // namespace
}  // namespace rubatlas::test
