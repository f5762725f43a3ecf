#include "reference_rows.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "blade/elastica.hpp"

namespace rubatlas::blade {

const std::vector<ReferenceRow>& reference_rows() {
  static const std::vector<ReferenceRow> kRows = [] {
    std::ifstream file(RUBATLAS_SOURCE_DIR "/tests/reference/elastica.json");
    const auto document = nlohmann::json::parse(file);
    std::vector<ReferenceRow> rows;
    for (const auto& row : document.at("rows")) {
      rows.push_back({row.at("mu").get<double>(), row.at("f").get<double>(), row.at("kappa").get<double>(),
                      row.at("delta_L").get<double>(), row.at("Delta_L").get<double>()});
    }
    return rows;
  }();
  return kRows;
}

long double bending_at_load(double friction, double load) {
  const long double beta = std::atan(static_cast<long double>(friction));
  const long double highest =
      0.999L * std::sqrt((std::numbers::pi_v<long double> - beta) * (std::numbers::pi_v<long double> + beta));
  const auto excess = [&](long double bending) { return equilibrium(friction, bending).load - load; };
  return boost::math::tools::bisect(excess, 0.0L, highest, boost::math::tools::eps_tolerance<long double>())
      .first;
}

}  // namespace rubatlas::blade
