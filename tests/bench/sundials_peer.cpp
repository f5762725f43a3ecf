/// SUNDIALS: ERKStep of ARKODE, orders 8 and 5, and CVODE, with their own rootfinding on g of each blade.
///
/// Each located root opens or closes a contact, and the solver starts anew there with the step that it has
/// just made. Revolutions end at stop times, so that sections are ends of steps.
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>
#include <stdexcept>

#include "contact_rotor.hpp"
#include "peer.hpp"
#include "problem.hpp"

namespace rubatlas::bench {
namespace {

constexpr double kFirstStep = 1e-3;       ///< in τ, behind an event
constexpr int kMostFailures = 50;         ///< of one step
constexpr long kMostSteps = 100'000'000;  ///< of one call: never the limit

int right_hand_side(realtype time, N_Vector state, N_Vector rates, void* rotor) {
  const bool exists =
      static_cast<ContactRotor*>(rotor)->evaluate(time, N_VGetArrayPointer(state), N_VGetArrayPointer(rates));
  return exists ? 0 : 1;  // recoverable: a shorter step may find the force
}

int gaps(realtype time, N_Vector state, realtype* gap, void* rotor) {
  const auto* of = static_cast<const ContactRotor*>(rotor);
  for (int k = 0; k < of->blade_count(); ++k) gap[k] = of->gap(k, time, N_VGetArrayPointer(state));
  return 0;
}

void expect(int flag, const char* call) {
  if (flag < 0)
    throw std::runtime_error(std::string("SUNDIALS: ") + call + " returned " + std::to_string(flag));
}

/// What is common to both: memory, and the vector of the state.
class SundialsState {
 public:
  SundialsState() {
    expect(SUNContext_Create(nullptr, &context_), "SUNContext_Create");
    vector_ = N_VNew_Serial(4, context_);
    N_VConst(0.0, vector_);
  }
  ~SundialsState() {
    N_VDestroy(vector_);
    SUNContext_Free(&context_);
  }
  SundialsState(const SundialsState&) = delete;
  SundialsState& operator=(const SundialsState&) = delete;

  [[nodiscard]] SUNContext context() const { return context_; }
  [[nodiscard]] N_Vector vector() const { return vector_; }
  [[nodiscard]] const double* values() const { return N_VGetArrayPointer(vector_); }

 private:
  SUNContext context_ = nullptr;
  N_Vector vector_ = nullptr;
};

/// How a call of a solver ended.
enum class Stop { at_stop_time, at_root, failed };

class Erk {
 public:
  Erk(SundialsState& state, ContactRotor& rotor, int order, const PeerSettings& settings) : state_(&state) {
    memory_ = ERKStepCreate(right_hand_side, 0.0, state.vector(), state.context());
    // The pairs with the best name at their order: Fehlberg's 7(8) is the only one of order 8 that it has.
    expect(ERKStepSetTableNum(memory_, order == 8 ? ARKODE_FEHLBERG_13_7_8 : ARKODE_DORMAND_PRINCE_7_4_5),
           "ERKStepSetTableNum");
    // Events are read off the interpolant: Hermite of the highest degree that it has.
    expect(ERKStepSetInterpolantDegree(memory_, 5), "ERKStepSetInterpolantDegree");
    expect(ERKStepSStolerances(memory_, 0.0, settings.tolerance * rotor.clearance()), "ERKStepSStolerances");
    expect(ERKStepSetUserData(memory_, &rotor), "ERKStepSetUserData");
    expect(ERKStepRootInit(memory_, rotor.blade_count(), gaps), "ERKStepRootInit");
    expect(ERKStepSetNoInactiveRootWarn(memory_), "ERKStepSetNoInactiveRootWarn");
    expect(ERKStepSetErrFile(memory_, nullptr), "ERKStepSetErrFile");
    // Seven in a row, its default, end a run where a contact starts steeply.
    expect(ERKStepSetMaxErrTestFails(memory_, kMostFailures), "ERKStepSetMaxErrTestFails");
    expect(ERKStepSetMaxNumSteps(memory_, kMostSteps), "ERKStepSetMaxNumSteps");

    if (std::isfinite(settings.max_step))
      expect(ERKStepSetMaxStep(memory_, settings.max_step), "ERKStepSetMaxStep");
  }
  ~Erk() { ERKStepFree(&memory_); }
  Erk(const Erk&) = delete;
  Erk& operator=(const Erk&) = delete;

  Stop evolve(double until, double& time) {
    expect(ERKStepSetStopTime(memory_, until), "ERKStepSetStopTime");
    const int flag = ERKStepEvolve(memory_, until, state_->vector(), &time, ARK_NORMAL);
    return flag < 0 ? Stop::failed : flag == ARK_ROOT_RETURN ? Stop::at_root : Stop::at_stop_time;
  }
  void roots(int* found) { expect(ERKStepGetRootInfo(memory_, found), "ERKStepGetRootInfo"); }
  /// The first step is short: a stage that asks for a force where there is none is final for ERKStep, and
  /// from a short first step it grows at once.
  void restart(double time) {
    expect(ERKStepReset(memory_, time, state_->vector()), "ERKStepReset");
    expect(ERKStepSetInitStep(memory_, kFirstStep), "ERKStepSetInitStep");
  }

 private:
  SundialsState* state_;
  void* memory_ = nullptr;
};

class Cvode {
 public:
  Cvode(SundialsState& state, ContactRotor& rotor, Multistep method, const PeerSettings& settings)
      : state_(&state) {
    memory_ = CVodeCreate(method == Multistep::adams ? CV_ADAMS : CV_BDF, state.context());
    expect(CVodeInit(memory_, right_hand_side, 0.0, state.vector()), "CVodeInit");
    expect(CVodeSStolerances(memory_, 0.0, settings.tolerance * rotor.clearance()), "CVodeSStolerances");
    expect(CVodeSetUserData(memory_, &rotor), "CVodeSetUserData");
    // Not stiff: fixed-point iteration with Adams. BDF as it is meant, with Newton and a dense Jacobian by
    // differences.
    if (method == Multistep::adams) {
      fixed_point_ = SUNNonlinSol_FixedPoint(state.vector(), 0, state.context());
      expect(CVodeSetNonlinearSolver(memory_, fixed_point_), "CVodeSetNonlinearSolver");
    } else {
      matrix_ = SUNDenseMatrix(4, 4, state.context());
      solver_ = SUNLinSol_Dense(state.vector(), matrix_, state.context());
      expect(CVodeSetLinearSolver(memory_, solver_, matrix_), "CVodeSetLinearSolver");
    }
    expect(CVodeRootInit(memory_, rotor.blade_count(), gaps), "CVodeRootInit");
    expect(CVodeSetNoInactiveRootWarn(memory_), "CVodeSetNoInactiveRootWarn");
    expect(CVodeSetMaxNumSteps(memory_, kMostSteps), "CVodeSetMaxNumSteps");
    expect(CVodeSetErrFile(memory_, nullptr), "CVodeSetErrFile");
    if (std::isfinite(settings.max_step))
      expect(CVodeSetMaxStep(memory_, settings.max_step), "CVodeSetMaxStep");
  }
  ~Cvode() {
    CVodeFree(&memory_);
    if (fixed_point_) SUNNonlinSolFree(fixed_point_);
    if (solver_) SUNLinSolFree(solver_);
    if (matrix_) SUNMatDestroy(matrix_);
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  Stop evolve(double until, double& time) {
    expect(CVodeSetStopTime(memory_, until), "CVodeSetStopTime");
    const int flag = CVode(memory_, until, state_->vector(), &time, CV_NORMAL);
    return flag < 0 ? Stop::failed : flag == CV_ROOT_RETURN ? Stop::at_root : Stop::at_stop_time;
  }
  void roots(int* found) { expect(CVodeGetRootInfo(memory_, found), "CVodeGetRootInfo"); }
  void restart(double time) { expect(CVodeReInit(memory_, time, state_->vector()), "CVodeReInit"); }

 private:
  SundialsState* state_;
  void* memory_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

template <class Solver, class Choice>
class SundialsPeer final : public Peer {
 public:
  SundialsPeer(std::string family, const std::string& variant, Choice choice)
      : Peer(std::move(family), variant), choice_(choice) {}

  [[nodiscard]] PeerRun run(double speed_ratio, int revolutions,
                            const PeerSettings& settings) const override {
    const settings::Scene scene;
    ContactRotor rotor(rotor_of(scene, speed_ratio), scene.blades.count,
                       contact_of(scene, shared_tables().curve));
    SundialsState state;
    Solver solver(state, rotor, choice_, settings);
    std::vector<int> found(static_cast<std::size_t>(scene.blades.count));
    PeerRun run;
    double time = 0.0;
    for (int revolution = 1; run.completed && revolution <= revolutions; ++revolution) {
      const double end = revolution * rotor.period();
      Stop stop = Stop::at_root;
      while (stop == Stop::at_root) {
        stop = solver.evolve(end, time);
        if (stop == Stop::at_root) {
          solver.roots(found.data());
          change_contacts(rotor, found, time, state.values());
          solver.restart(time);
        }
      }
      if (stop == Stop::failed) {
        run.completed = false;
      } else {
        const double* at = state.values();
        run.sections.push_back({at[0], at[1], at[2], at[3]});
      }
    }
    run.work.right_hand_sides = rotor.right_hand_sides();
    run.work.touchdowns = rotor.touchdowns();
    return run;
  }

 private:
  /// `found`: +1 where g of a blade rises through zero, −1 where it falls.
  static void change_contacts(ContactRotor& rotor, const std::vector<int>& found, double time,
                              const double* state) {
    for (std::size_t k = 0; k < found.size(); ++k) {
      const int blade = static_cast<int>(k);
      if (found[k] > 0 && !rotor.is_open(blade)) rotor.touch_down(blade, time, state);
      if (found[k] < 0 && rotor.is_open(blade)) rotor.lift_off(blade);
    }
  }

  Choice choice_;
};

}  // namespace

std::unique_ptr<Peer> make_arkode(int order) {
  return std::make_unique<SundialsPeer<Erk, int>>("ARKODE", "ERKStep order " + std::to_string(order), order);
}

std::unique_ptr<Peer> make_cvode(Multistep method) {
  return std::make_unique<SundialsPeer<Cvode, Multistep>>(
      "CVODE", method == Multistep::adams ? "Adams" : "BDF", method);
}

}  // namespace rubatlas::bench
