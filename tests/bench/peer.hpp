/// What is compared: a solver that takes the default rotor from rest through some revolutions.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "blade/elastica_curve.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::bench {

/// What a peer made of one point.
struct PeerRun {
  bool completed = true;                       ///< to the last revolution
  std::vector<motion::SectionState> sections;  ///< after revolutions 1, 2, …
  motion::WorkCounts work;  ///< of others than this program right-hand sides and touch-downs only
};

/// How a peer is asked to run.
struct PeerSettings {
  double tolerance = 1e-9;  ///< local error of a step relative to the clearance
  double max_step = std::numeric_limits<double>::infinity();  ///< longest step in τ
};

/// Blade tables are shared by all peers and made before any of them is timed.
struct SharedTables {
  std::shared_ptr<const blade::ElasticaCurve> curve;
  std::shared_ptr<assembly::BladeTables> blades;
};
const SharedTables& shared_tables();

class Peer {
 public:
  /// `family` is the library or program, `variant` what of it; may be empty.
  Peer(std::string family, const std::string& variant)
      : family_(std::move(family)), name_(variant.empty() ? family_ : family_ + " " + variant) {}
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  [[nodiscard]] const std::string& family() const { return family_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// From rest at phase 0 through `revolutions` revolutions at one speed ratio.
  [[nodiscard]] virtual PeerRun run(double speed_ratio, int revolutions,
                                    const PeerSettings& settings) const = 0;

 private:
  std::string family_;
  std::string name_;
};

/// This program's methods, through the same door that the atlas uses.
std::unique_ptr<Peer> make_hybrid();
std::unique_ptr<Peer> make_collocation();
/// The published scheme; dF [N] is its step in the search for the force.
std::unique_ptr<Peer> make_paper(double force_increment);
/// Boost.odeint: dopri5 with dense output, without and with our event location.
std::unique_ptr<Peer> make_odeint_dopri5();
std::unique_ptr<Peer> make_odeint_dopri5_located();
/// SUNDIALS with its own rootfinding on g of each blade.
std::unique_ptr<Peer> make_arkode(int order);
enum class Multistep : std::uint8_t { adams, bdf };
std::unique_ptr<Peer> make_cvode(Multistep method);

}  // namespace rubatlas::bench
