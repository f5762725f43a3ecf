/// This program's own methods.
#include "peer.hpp"
#include "problem.hpp"

namespace rubatlas::bench {

const SharedTables& shared_tables() {
  static const SharedTables kTables{std::make_shared<blade::ElasticaCurve>(scene::Scene().contact.friction),
                                    solve::make_blade_tables()};
  return kTables;
}

namespace {

class LineSolverPeer final : public Peer {
 public:
  using Peer::Peer;

  [[nodiscard]] PeerRun run(double speed_ratio, int revolutions,
                            const PeerSettings& settings) const override {
    scene::Scene scene = default_scene(revolutions, settings.tolerance);
    scene.protocol = {0, revolutions, 64};  // every section is kept, and compared
    const auto solver = solve::make_line_solver(scene, line_of(scene, speed_ratio), shared_tables().blades);
    const solve::PointOutcome outcome = solver->run(speed_ratio, {0.0, 0.0, 0.0, 0.0}, [] {});
    return {outcome.status == solve::PointStatus::done, sections_of(outcome.rows.front()), outcome.work};
  }
};

}  // namespace

std::unique_ptr<Peer> make_hybrid() {
  return std::make_unique<LineSolverPeer>("hybrid", "");
}

}  // namespace rubatlas::bench
