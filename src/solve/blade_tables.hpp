/// Blade tables, one per friction coefficient, made on first use.
#pragma once

#include <map>
#include <memory>

#include "blade/elastica_curve.hpp"
#include "solve/line_solver.hpp"

namespace rubatlas::solve {

class BladeTables {
 public:
  std::shared_ptr<const blade::ElasticaCurve> curve(double friction) {
    auto& entry = curves_[friction];
    if (!entry) entry = std::make_shared<blade::ElasticaCurve>(friction);
    return entry;
  }

 private:
  std::map<double, std::shared_ptr<const blade::ElasticaCurve>> curves_;
};

}  // namespace rubatlas::solve
