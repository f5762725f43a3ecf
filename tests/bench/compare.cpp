/// Side by side: this program and general solvers on the same points, from the same forces, to the same
/// accuracy.
///
///   compare [REPEATS [REVOLUTIONS]]      default: 5 repeats, 60 revolutions a point
///
/// First each peer's tolerance is tightened until its error is that of `hybrid` at 1e-9; then Google
/// Benchmark times all of them, repeats interleaved at random. Prints markdown tables.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <cstdlib>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "comparison.hpp"

namespace rubatlas::bench {
namespace {

constexpr double kTolerance = 1e-9;
constexpr double kStepLimit = 0.02;  ///< in τ: no contact of the default line is shorter than a few of these
constexpr double kLooserTolerance = 1e-6;
constexpr double kLoosestTolerance = 1e-2;
constexpr int kPaperRevolutions = 10;  ///< it takes that long
constexpr int kSpeeds = 15;
constexpr double kFirstSpeed = 0.1;
constexpr double kLastSpeed = 0.8;

std::vector<double> line_of_speeds() {
  std::vector<double> speeds;
  for (int i = 0; i < kSpeeds; ++i)
    speeds.push_back(kFirstSpeed + (kLastSpeed - kFirstSpeed) * i / (kSpeeds - 1));
  return speeds;
}

/// dF [N] and tolerance that go together: the smaller of them alone only costs.
struct PaperKnobs {
  double force_increment;
  double tolerance;
};

Competitor competitor(std::shared_ptr<const Peer> peer, const PeerSettings& settings,
                      const std::vector<double>& speeds, int revolutions) {
  Competitor result;
  result.settings = settings;
  result.accuracy = accuracy_of(*peer, settings);
  result.touchdowns = touchdowns_of(*peer, settings, speeds);
  result.runs.resize(speeds.size());
  result.times.resize(speeds.size());
  result.revolutions = revolutions;
  result.peer = std::move(peer);
  return result;
}

Comparison competitors(int revolutions) {
  Comparison comparison;
  comparison.speed_ratios = line_of_speeds();
  const std::shared_ptr<const Peer> hybrid = make_hybrid();
  // hybrid's own error at its default tolerance is what the others have to reach; 1e-9 where it is better.
  comparison.target = std::max(kTolerance, accuracy_of(*hybrid, {kTolerance, kStepLimit}).typical_error);
  const auto matched = [&](std::shared_ptr<const Peer> peer, double step_limit) {
    fmt::print(stderr, "matching the accuracy of {}, step limit {}\n", peer->name(), step_limit);
    const PeerSettings settings = match_accuracy(*peer, {kTolerance, step_limit}, comparison.target);
    return competitor(std::move(peer), settings, comparison.speed_ratios, revolutions);
  };
  comparison.competitors.push_back(matched(hybrid, kStepLimit));
  const std::shared_ptr<const Peer> collocation = make_collocation();
  comparison.competitors.push_back(
      competitor(collocation, {kTolerance, kStepLimit}, comparison.speed_ratios, revolutions));
  // It errs less than its tolerance: at equal error it may have a looser one.
  comparison.competitors.push_back(
      competitor(collocation, match_accuracy(*collocation, {kLooserTolerance, kStepLimit}, comparison.target),
                 comparison.speed_ratios, revolutions));
  const std::vector<std::shared_ptr<const Peer>> peers{
      make_odeint_dopri5(), make_odeint_dopri5_located(), make_arkode(8),
      make_arkode(5),       make_cvode(Multistep::adams), make_cvode(Multistep::bdf)};
  for (const auto& peer : peers) comparison.competitors.push_back(matched(peer, kStepLimit));
  // No tolerance brings this one to the target: three stages of what it reaches, each with hybrid as accurate
  // as that.
  for (const PaperKnobs& knobs : {PaperKnobs{0.4, 1e-5}, PaperKnobs{0.04, 1e-6}, PaperKnobs{0.004, 1e-7}}) {
    fmt::print(stderr, "paper, dF {} N\n", knobs.force_increment);
    comparison.paper.push_back(competitor(make_paper(knobs.force_increment), {knobs.tolerance, kStepLimit},
                                          comparison.speed_ratios, kPaperRevolutions));
    const double reached = comparison.paper.back().accuracy.typical_error;
    comparison.paper.push_back(competitor(hybrid,
                                          match_accuracy(*hybrid, {kLoosestTolerance, kStepLimit}, reached),
                                          comparison.speed_ratios, kPaperRevolutions));
  }
  for (const double limit : {0.05, 0.1, 0.2}) {
    for (const std::size_t fast : {1, 3, 4})  // the fastest of each library
      comparison.longer_steps.push_back(matched(peers[fast], limit));
  }
  for (std::size_t i = 0; i < comparison.whole_points.size(); ++i) {
    comparison.whole_points[i] = comparison.competitors[i];
    comparison.whole_points[i].revolutions = 300;
  }
  for (const auto& peer : peers) {
    Competitor free;
    free.settings.tolerance = kTolerance;
    free.accuracy = accuracy_of(*peer, free.settings);
    free.touchdowns = touchdowns_of(*peer, free.settings, comparison.speed_ratios);
    free.peer = peer;
    comparison.without_limit.push_back(std::move(free));
  }
  return comparison;
}

/// Where the times that Google Benchmark measures belong, by the name of the benchmark.
using Places = std::map<std::string, std::vector<double>*>;

class Collector final : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(const Places& places) : places_(&places) {}
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      places_->at(run.run_name.function_name)
          ->push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
    }
  }

 private:
  const Places* places_;
};

void time_all(Comparison& comparison, int repeats) {
  constexpr int kQuickRuns = 5;  ///< runs in a repeat of what takes milliseconds
  Places places;
  const auto register_one = [&](Competitor& of, int runs) {
    for (std::size_t i = 0; i < comparison.speed_ratios.size(); ++i) {
      const double speed = comparison.speed_ratios[i];
      const auto body = [&of, i, speed](benchmark::State& state) {
        for (auto _ : state) {
          of.runs[i] = of.peer->run(speed, of.revolutions, of.settings);
          benchmark::DoNotOptimize(of.runs[i]);
        }
      };
      const std::string name = fmt::format("{}: {}", places.size(), of.peer->name());
      places[name] = &of.times[i];
      benchmark::RegisterBenchmark(name.c_str(), body)->Iterations(runs)->Repetitions(repeats);
    }
  };
  for (Competitor& of : comparison.competitors) register_one(of, is_own(of) ? kQuickRuns : 1);
  for (Competitor& of : comparison.longer_steps) register_one(of, 1);
  for (Competitor& of : comparison.paper) register_one(of, is_own(of) ? kQuickRuns : 1);
  for (Competitor& of : comparison.whole_points) register_one(of, 1);
  std::vector<std::string> flags{"compare", "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> arguments;
  for (std::string& flag : flags) arguments.push_back(flag.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  Collector collector(places);
  benchmark::RunSpecifiedBenchmarks(&collector);
}

int run(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  const int revolutions = argc > 2 ? std::atoi(argv[2]) : 60;
  if (repeats < 1 || revolutions < 1 || argc > 3) {
    fmt::print(stderr, "usage: compare [REPEATS [REVOLUTIONS]]\n");
    return 2;
  }
  shared_tables();
  Comparison comparison = competitors(revolutions);
  fmt::print(stderr, "timing {} competitors at {} speeds, {} repeats\n", comparison.competitors.size(),
             comparison.speed_ratios.size(), repeats);
  time_all(comparison, repeats);
  fmt::print("{}", tables(comparison));
  return 0;
}

}  // namespace
}  // namespace rubatlas::bench

int main(int argc, char** argv) {
  try {
    return rubatlas::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "compare: {}\n", error.what());
    return 1;
  }
}
