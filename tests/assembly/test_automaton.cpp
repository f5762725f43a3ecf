/// The automaton of a blade: the page and the program have the same table, and every event of random motions,
/// of every law and effect, is one of its transitions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../support/point.hpp"
#include "modes/motion_listener.hpp"
#include "motion/automaton.hpp"
#include "random_scene.hpp"

namespace rubatlas::test {
namespace {

using modes::Guard;
using motion::BladeMode;

std::string name(BladeMode mode) {
  constexpr std::array kNames{"free", "slips", "rests", "stands"};
  return kNames[static_cast<std::size_t>(mode)];
}
std::string name(Guard guard) {
  constexpr std::array kNames{"horizon",     "lift_off",   "touch_down", "slip_reversal",
                              "comes_loose", "pressed_in", "snap"};
  return kNames.at(static_cast<std::size_t>(guard));
}

TEST(Automaton, OfThePageIsThatOfTheProgram) {
  std::ifstream file(RUBATLAS_SOURCE_DIR "/src/model.md");
  std::stringstream page;
  page << file.rdbuf();
  std::string table;
  std::set<std::string> arrows;
  for (const motion::Transition& row : motion::kTransitions) {
    table +=
        fmt::format("| {} | {} | {} | {} |\n", name(row.mode), name(row.guard), row.reset, name(row.next));
    arrows.insert(fmt::format("    {} --> {}: {}\n", name(row.mode), name(row.next), name(row.guard)));
  }
  EXPECT_NE(page.str().find("| mode | guard | reset | next |\n|---|---|---|---|\n" + table + "\n"),
            std::string::npos)
      << "section 4.10 should have\n"
      << table;
  std::set<std::string> drawn;
  for (std::string line; std::getline(page, line);) {
    if (line.find(" --> ") != std::string::npos) drawn.insert(line + "\n");
  }
  EXPECT_EQ(drawn, arrows) << "the figure has the arrows of the table";
}

/// Follows each blade through the table. What the events leave open is kept as a set of modes.
class Follower final : public modes::MotionListener {
 public:
  explicit Follower(int blades)
      : modes_(static_cast<std::size_t>(blades),
               {BladeMode::free, BladeMode::slips, BladeMode::rests, BladeMode::stands}) {}
  void piece(trajectory::MotionPiece& /*piece*/) override {}
  void event(const modes::Event& event) override {
    auto& modes = modes_[static_cast<std::size_t>(event.blade)];
    std::set<BladeMode> next;
    for (const motion::Transition& row : motion::kTransitions) {
      if (row.told && row.guard == event.kind && modes.contains(row.mode)) next.insert(row.next);
    }
    // An event of which the tip rests, or slips, says so.
    if (event.slip == 0.0) {
      std::erase_if(next,
                    [](BladeMode mode) { return mode == BladeMode::slips || mode == BladeMode::stands; });
    } else {
      next.erase(BladeMode::rests);
    }
    if (next.empty()) {
      std::string from;
      for (const BladeMode mode : modes) from += " " + name(mode);
      ADD_FAILURE() << "blade " << event.blade << ": " << name(event.kind) << ", s = " << event.slip
                    << ", from" << from;
      return;
    }
    modes = next;
    // What listeners are not told of may have followed.
    for (const motion::Transition& row : motion::kTransitions) {
      if (!row.told && modes.contains(row.mode)) modes.insert(row.next);
    }
    seen.insert(event.kind);
  }
  std::set<Guard> seen;

 private:
  std::vector<std::set<BladeMode>> modes_;
};

TEST(Automaton, HasEveryEventOfRandomMotions) {
  const auto tables = assembly::make_blade_tables();
  std::set<Guard> seen;
  // Of any kind, and of those whose tips may stick, which are rare.
  constexpr int kOfAnyKind = 80;
  constexpr int kThatStick = 25;
  // A motion asks after each of its few revolutions, and after each 2 ms of work, that of its observables
  // with it: the few that take a second each have the events of the others, more often.
  constexpr int kMostQuestions = 100;
  int followed = 0;
  int sticking = 0;
  for (std::uint64_t index = 0; followed < kOfAnyKind || sticking < kThatStick; ++index) {
    const settings::Scene scene = random_scene(index);
    if (followed >= kOfAnyKind && !scene.stick) continue;
    SCOPED_TRACE("random scene " + std::to_string(index) + ": " + random_scene_text(index));
    const double speed_ratio = scene.grid.speed_ratio.front();
    const motion::SectionState start{scene.initial.x, scene.initial.y, scene.initial.vx, scene.initial.vy};
    const auto solver = solver_of(scene, tables);
    int questions = 0;
    const auto outcome = solver->run(speed_ratio, start, [&] { return ++questions <= kMostQuestions; });
    if (outcome.status == ending::PointStatus::pending) continue;
    Follower follower(scene.blades.count);
    solver->listen(speed_ratio, start, follower);
    seen.insert(follower.seen.begin(), follower.seen.end());
    ++followed;
    if (scene.stick) ++sticking;
  }
  for (const Guard guard : {Guard::lift_off, Guard::touch_down, Guard::slip_reversal, Guard::comes_loose})
    EXPECT_TRUE(seen.contains(guard)) << name(guard);
}

}  // namespace
}  // namespace rubatlas::test
