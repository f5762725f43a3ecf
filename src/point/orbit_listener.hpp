/// Keeps uniform samples of a motion, and closer samples of its contacts, for the command `orbit`.
#pragma once

#include <optional>
#include <vector>

#include "modes/motion_listener.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::point {

class OrbitListener final : public modes::MotionListener {
 public:
  OrbitListener(double period, int samples_per_revolution, int blade_count);

  void piece(trajectory::MotionPiece& piece) override;
  void event(const modes::Event& event) override;
  void speed_changes(double speed_ratio) override;
  void revolution_ends(const motion::SectionState& section) override;

  [[nodiscard]] Orbit take();

 private:
  struct Sample {
    double time;
    double force;
    motion::SectionState state;
  };
  struct Contact {
    int blade = 0;
    std::vector<Sample> samples;
  };

  [[nodiscard]] double since_start(double time) const;
  void sample_orbit(trajectory::MotionPiece& piece);
  void sample_contact(trajectory::MotionPiece& piece, std::size_t contact);

  double period_;
  int samples_per_revolution_;
  int sample_ = 0;  ///< next one within the revolution
  int revolution_ = 0;
  double begin_ = 0.0;  ///< τ when the revolution `since_` began, the first at the present speed
  int since_ = 0;
  Orbit orbit_;
  std::vector<Contact> contacts_;                 ///< in the order in which they begin
  std::vector<std::optional<std::size_t>> open_;  ///< of each blade, the index of its open contact
  bool may_jump_ = false;                         ///< an event has come since the last piece
};

}  // namespace rubatlas::point
