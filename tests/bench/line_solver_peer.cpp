/// This program's own methods.
#include <fmt/core.h>

#include "assembly/make_line_solver.hpp"
#include "peer.hpp"
#include "problem.hpp"

namespace rubatlas::bench {

const SharedTables& shared_tables() {
  static const SharedTables kTables{
      std::make_shared<blade::ElasticaCurve>(settings::Scene().contact.friction),
      assembly::make_blade_tables()};
  return kTables;
}

namespace {

class LineSolverPeer final : public Peer {
 public:
  /// `force_increment` dF [N] is read by `paper` only.
  LineSolverPeer(std::string family, const std::string& variant, settings::Method method,
                 double force_increment)
      : Peer(std::move(family), variant), method_(method), force_increment_(force_increment) {}

  [[nodiscard]] PeerRun run(double speed_ratio, int revolutions,
                            const PeerSettings& settings) const override {
    settings::Scene scene = default_scene(revolutions, settings.tolerance);
    scene.protocol = {0, revolutions, 64};  // every section is kept, and compared
    scene.accuracy.method = method_;
    scene.accuracy.force_increment = force_increment_;
    scene.accuracy.max_step = settings.max_step;
    const auto solver =
        assembly::make_line_solver(scene, line_of(scene, speed_ratio), shared_tables().blades);
    const point::PointOutcome outcome = solver->run(speed_ratio, motion::SectionState{});
    return {outcome.status == ending::PointStatus::done, sections_of(outcome.rows.front()), outcome.work};
  }

 private:
  settings::Method method_;
  double force_increment_;
};

}  // namespace

std::unique_ptr<Peer> make_hybrid() {
  return std::make_unique<LineSolverPeer>("hybrid", "", settings::Method::hybrid, 0.0);
}

std::unique_ptr<Peer> make_collocation() {
  return std::make_unique<LineSolverPeer>("collocation", "", settings::Method::collocation, 0.0);
}

std::unique_ptr<Peer> make_paper(double force_increment) {
  return std::make_unique<LineSolverPeer>("paper", fmt::format("dF {:g} N", force_increment),
                                          settings::Method::paper, force_increment);
}

}  // namespace rubatlas::bench
