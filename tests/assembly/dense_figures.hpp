/// The figures of a motion from dense samples of its pieces, each by its definition: what the observables,
/// which look at a few places only, are held against.
#pragma once

#include <array>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modes/motion_listener.hpp"
#include "settings/scene.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::test {

class DenseFigures final : public modes::MotionListener {
 public:
  /// Of a point without a transient.
  DenseFigures(const settings::Scene& scene, double speed_ratio);

  void piece(trajectory::MotionPiece& piece) override;
  void event(const modes::Event& event) override;
  void speed_changes(double speed_ratio) override;
  void revolution_ends(const trajectory::State& section) override;

  /// A row of the atlas, and the size against which its errors count.
  struct Figure {
    std::vector<double> values;
    double size;
  };
  /// Of an observable; nothing where samples do not tell (exponents, a side that rounding decides).
  [[nodiscard]] std::optional<Figure> figure(std::string_view observable) const;
  /// Blades touch, and never deeper than some millions of roundings of a place: rounding shows in their
  /// forces.
  [[nodiscard]] bool only_brushes() const;
  /// The shaft is never faster than a hundred tolerances: between nodes and in steps its velocity errs by
  /// some.
  [[nodiscard]] bool hardly_moves() const;
  /// Sentences about tips that are in the ring without a contact, or in contact outside of it.
  [[nodiscard]] const std::vector<std::string>& contradictions() const { return contradictions_; }

 private:
  /// A local maximum of a tip's radius, or the deepest place of a contact.
  struct Top {
    double overlap;  ///< [m]
    double side;     ///< s ct [m]
  };
  struct Blade {
    double force = 0.0;   ///< largest [N]
    double strain = 0.0;  ///< largest [-]
    double touchdowns = 0.0;
    double time = 0.0;      ///< in contact [τ]
    double impulse = 0.0;   ///< ∫ F dτ [N]
    double friction = 0.0;  ///< ∫ |c F v| dτ [J]
    bool in_contact = false;
    bool begun = false;          ///< the contact has begun within the revolutions that are followed
    std::optional<Top> deepest;  ///< of the contact
    std::optional<trajectory::Tip> before;  ///< at the end of the last piece
  };
  /// The mean of a quantity, and of its absolute value.
  struct Mean {
    double sum = 0.0;
    double absolute = 0.0;
    void add(double amount) {
      sum += amount;
      absolute += std::abs(amount);
    }
  };
  void follow_displacement(trajectory::MotionPiece& piece, const std::vector<double>& times);
  void follow_loads(trajectory::MotionPiece& piece, const std::vector<double>& times);
  void follow_tip(trajectory::MotionPiece& piece, const std::vector<double>& times, int number,
                  bool in_contact);
  void follow_powers(trajectory::MotionPiece& piece);
  void ends_contact(Blade& blade);
  [[nodiscard]] Figure of_blades(double Blade::*value, double unit) const;
  [[nodiscard]] Figure mean(const Mean& quantity, double unit) const;
  [[nodiscard]] Figure spectrum(bool of_whirl) const;
  [[nodiscard]] std::optional<Figure> grazing_side() const;
  [[nodiscard]] double closeness_of_tips() const;

  settings::Scene scene_;
  double speed_ratio_;
  double period_;
  std::vector<Blade> blades_;
  double displacement_ = 0.0;  ///< [m]
  double time_ = 0.0;          ///< followed [τ]
  double in_contact_ = 0.0;    ///< [τ]
  double approach_ = 0.0;      ///< [m per unit τ]
  double fastest_ = 0.0;       ///< |z'| of the shaft [m per unit τ]
  double deepest_ = -1.0;      ///< overlap of a tip in contact [m], negative without one
  Mean friction_, viscous_, deformation_, torque_;
  std::optional<Top> nearest_miss_, lightest_touch_;
  std::vector<double> sections_, passings_;
  std::vector<std::complex<double>> samples_;
  int sample_ = 0;   ///< next one within the revolution
  int passing_ = 1;  ///< likewise
  std::optional<trajectory::State> revolution_began_;
  std::vector<double> growth_;  ///< what each blade has worn off [m]
  std::vector<std::string> contradictions_;
};

}  // namespace rubatlas::test
