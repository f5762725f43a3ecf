/// The carried contact of several motions side by side: the parts of `modes::CarriedEquation` with a motion
/// in each lane, and an attempt of a step.
///
/// Included by the files `lanes_<processor>.cpp` only, which are compiled for their processor. They may
/// define nothing that another source could link to but `attempt_<processor>`: a test looks at their symbols.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <experimental/simd>

#include "batch/lane_block.hpp"
#include "blade/elastica_curve.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/pose.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "modes/carried_equation.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"

/// Lanes as the numbers of Eigen's arrays.
template <class Abi>
struct Eigen::NumTraits<std::experimental::simd<double, Abi>>
    : Eigen::GenericNumTraits<std::experimental::simd<double, Abi>> {
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};

namespace rubatlas::batch {

template <int kLanes>
using Lanes = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, kLanes>>;

/// Load, shortening and deflection in each lane.
template <int kLanes>
using CurveColumns = Eigen::Array<Lanes<kLanes>, 3, 1>;

/// `Processor` knows how rows of a table become columns:
///     kLanes
///     columns(rows, offset)   three numbers of each lane's own row
template <class Processor>
class LaneMotion {
 public:
  static constexpr int kLanes = Processor::kLanes;
  using Number = Lanes<kLanes>;
  using Block = LaneBlock<kLanes>;

  explicit LaneMotion(Block& block)
      : block_(block),
        rotor_{row(block.damping_ratio), row(block.misalignment), row(block.force_unit)},
        blades_{&block, row(block.speed)},
        law_{&block,
             {{row(block.reach), row(block.ring_radius)},
              row(block.length),
              row(block.load_unit),
              row(block.strain_unit),
              row(block.friction),
              0.0},
             row(block.mirror)},
        forcing_{&block},
        equation_{&rotor_,
                  &blades_,
                  &law_,
                  &forcing_,
                  row(block.slip),
                  row(block.scale),
                  {row(block.anchor_time), {row(block.anchor_cosine), row(block.anchor_sine)}}} {}

  void attempt() {
    State start, derivative;
    for (int c = 0; c < 6; ++c) {
      start[c] = row(block_.start[c]);
      derivative[c] = row(block_.stages[0][c]);
    }
    step_.resume(start, derivative);
    step_.attempt(*this, row(block_.size));
    for (std::size_t s = 1; s <= kEvaluationsOfAttempt; ++s) {
      for (int c = 0; c < 6; ++c) store(step_.stage(s)[c], block_.stages[s][c]);
    }
    for (int c = 0; c < 6; ++c) store(step_.end()[c], block_.end[c]);
    store(last_.force.radial, block_.force_radial);
    store(last_.force.tangential, block_.force_tangential);
    store(last_.force.normal, block_.load);
    store(last_.force.shortening, block_.shortening);
    store(last_.force.root_strain, block_.root_strain);
    store(last_.force.slip_velocity, block_.slip_velocity);
    store(last_.residual, block_.residual);
    store(last_.bending_slope, block_.bending_slope);
    store(last_.time_slope, block_.time_slope);
    store(acceleration_.real(), block_.acceleration_x);
    store(acceleration_.imag(), block_.acceleration_y);
  }

  using State = rotor::ContactStateOf<Number>;
  // One copy of the right-hand side: twelve would not fit the instruction cache.
  [[gnu::noinline, gnu::flatten]] bool operator()(const State& state, State& derivative) {
    return equation_.evaluate(state, derivative, last_, acceleration_,
                              [](const auto& /*constraint*/, const auto& /*force*/) { return true; });
  }

 private:
  using Row = typename Block::Row;
  static Number row(const Row& from) { return Number(&from.lane[0], std::experimental::vector_aligned); }
  static void store(const Number& number, Row& to) {
    number.copy_to(&to.lane[0], std::experimental::vector_aligned);
  }

  struct Rotor {
    Number damping_ratio, misalignment, force_unit;
  };

  struct Blades {
    const Block* block;
    Number speed;

    struct Anchor {
      Number time;
      contact::DirectionOf<Number> direction;
    };
    [[nodiscard]] const Number& angular_speed(const Number& /*time*/) const { return speed; }
    [[nodiscard]] contact::DirectionOf<Number> direction_near(const Anchor& anchor,
                                                              const Number& time) const {
      const Number angle = speed * (time - anchor.time);
      contact::DirectionOf<Number> er = rotor::turned(anchor.direction, angle);
      const auto near = angle * angle < rotor::kFarTurned;
      if (!all_of(near)) [[unlikely]] {
        for (std::size_t i = 0; i < kLanes; ++i) {
          if (near[i]) continue;
          double cosine = 0.0, sine = 0.0;
          direct(*block->request[i], time[i], cosine, sine);
          er.cosine[i] = cosine;
          er.sine[i] = sine;
        }
      }
      return er;
    }
  };

  struct Law {
    const Block* block;
    contact::ElasticBladeOf<Number> blade;
    Number mirror;

    [[nodiscard]] const contact::GeometryOf<Number>& geometry() const { return blade.geometry; }
    [[nodiscard]] contact::ConstraintOf<Number> constraint(const contact::PoseOf<Number>& at,
                                                           const Number& slip, const Number& bending,
                                                           const Number& angular_speed) const {
      const Number size = abs(bending);
      const double* rows[kLanes];  // NOLINT(*-avoid-c-arrays): see lane_block.hpp
      Number centre, inverse_half_width;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const blade::ElasticaCurve::Piece& piece = block->curve[i]->piece(size[i]);
        rows[i] = &piece.coefficients[0][0];
        centre[i] = piece.centre;
        inverse_half_width[i] = piece.inverse_half_width;
      }
      const auto point =
          blade::curve_point(bending, centre, inverse_half_width, mirror,
                             [&](std::size_t power) { return Processor::columns(rows, 4 * power); });
      return contact::constraint_of<false>(blade, at, slip, point, angular_speed);
    }
  };

  struct Forcing {
    static constexpr bool kPresent = true;
    const Block* block;

    [[nodiscard]] contact::PlaneVector<Number> acceleration(const Number& time) const {
      Number x = -0.0, y = -0.0;
      if (block->any_unbalance) {
        for (std::size_t i = 0; i < kLanes; ++i) {
          double of_lane_x = -0.0, of_lane_y = -0.0;
          unbalance(*block->request[i], time[i], of_lane_x, of_lane_y);
          x[i] = of_lane_x;
          y[i] = of_lane_y;
        }
      }
      return {x, y};
    }
  };

  Block& block_;
  Rotor rotor_;
  Blades blades_;
  Law law_;
  Forcing forcing_;
  modes::CarriedEquation<Number, Rotor, Blades, Law, Forcing> equation_;
  integrate::RungeKutta<integrate::DormandPrince853, 6, 6, Number> step_;
  contact::ConstraintOf<Number> last_;
  contact::PlaneVector<Number> acceleration_{0.0, 0.0};
};

}  // namespace rubatlas::batch
