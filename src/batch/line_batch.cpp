#include "batch/line_batch.hpp"

#include <algorithm>
#include <chrono>

#include "assembly/make_line_solver.hpp"
#include "batch/contact_lanes.hpp"
#include "batch/line_fibers.hpp"
#include "batch/shared_attempts.hpp"
#include "settings/combinations.hpp"

namespace rubatlas::batch {
namespace {

/// One line after the other, on the caller's stack.
class OneByOne final : public LineBatch {
 public:
  void begin(int /*seat*/, point::LineSolver& solver, double speed_ratio,
             const motion::PointStart& start) override {
    solver_ = &solver;
    speed_ratio_ = speed_ratio;
    start_ = start;
  }
  Finished advance(const modes::GoOn& go_on) override {
    const auto began = std::chrono::steady_clock::now();
    Finished finished;
    finished.outcome = solver_->run(speed_ratio_, start_, go_on);
    finished.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return finished;
  }
  [[nodiscard]] LaneCounts counts() const override { return {}; }

 private:
  point::LineSolver* solver_ = nullptr;
  double speed_ratio_ = 0.0;
  motion::PointStart start_;
};

/// The lanes know one carried contact of the elastica, under no forcing or an unbalance.
std::string_view why_not(const settings::Scene& scene) {
  if (scene.contact.law == settings::ContactLaw::elastic_ring) return "the elastic ring has nothing to carry";
  if (scene.contact.law != settings::ContactLaw::elastica) return "the lanes know the elastica only";
  if (scene.accuracy.method != settings::Method::hybrid) return "only the method `hybrid` is made for it";
  const auto combinations = settings::combinations_in(scene);
  const bool more_acts = std::ranges::any_of(combinations, [](const settings::Combination& combination) {
    return combination.family->kind != settings::MotionFamily::paper_s_rotor;
  });
  return more_acts ? "of effects the lanes know the unbalance only" : "";
}

}  // namespace

Width width_of(const settings::Scene& scene, int most) {
#ifdef RUBATLAS_NO_FIBERS
  return {1, "built with sanitizers, which do not follow stacks that change"};
#endif
  if (const auto reason = why_not(scene); !reason.empty()) return {1, reason};
  const int lanes = lanes_of_processor();
  if (lanes == 1) return {1, "the processor has no AVX2"};
  if (most > 0 && most < lanes) return {most, "so many were asked for"};
  return {lanes, lanes == 8 ? "AVX-512" : "AVX2"};
}

std::unique_ptr<point::LineSolver> make_line_solver(const Width& width, const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<assembly::BladeTables>& tables) {
  if (width.seats == 1) return assembly::make_line_solver(scene, line, tables);
  return make_sharing_line_solver(scene, line, *tables);
}

std::unique_ptr<LineBatch> make_line_batch(const Width& width) {
  if (width.seats == 1) return std::make_unique<OneByOne>();
  return std::make_unique<LineFibers>(width.seats);
}

}  // namespace rubatlas::batch
