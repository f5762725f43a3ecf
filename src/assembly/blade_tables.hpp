/// Blade tables, one per friction coefficient, theory and axial compliance, made on first use.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "blade/elastica_curve.hpp"

namespace rubatlas::assembly {

class BladeTables {
 public:
  /// `axial_compliance`: ε [-].
  std::shared_ptr<const blade::ElasticaCurve> curve(double friction,
                                                    blade::Theory theory = blade::Theory::elastica,
                                                    double axial_compliance = 0.0) {
    auto& entry = curves_[{friction, theory, axial_compliance}];
    if (!entry) entry = std::make_shared<blade::ElasticaCurve>(friction, theory, axial_compliance);
    return entry;
  }

 private:
  std::map<std::tuple<double, blade::Theory, double>, std::shared_ptr<const blade::ElasticaCurve>> curves_;
};

}  // namespace rubatlas::assembly
