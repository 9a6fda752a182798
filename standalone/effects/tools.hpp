// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_TOOLS_HPP
#define SOLIDEM_EFFECTS_TOOLS_HPP

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/acting_effects.hpp"
#include "effects/contact_heat.hpp"
#include "effects/effect.hpp"
#include "effects/tool_motion.hpp"
#include "laws/linear_contact.hpp"
#include "model/rigid_shape.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// What elements feel of a tool.
struct ToolContact {
  std::optional<double> stiffness;    ///< k_n, N/m
  double stiffness_ratio = 1;         ///< k_n over that of the bonds, where it is not given
  double tangential_ratio = 2.0 / 7;  ///< k_t / k_n
  double friction = 0;                ///< μ
  double restitution = 1;             ///< e
  double effusivity = 0;  ///< W s^½/(m² K), as it takes heat of friction; 0: it takes none
  std::optional<TimeFunction> temperature{};  ///< K, of what touches it; none: no heat passes
};

/// A rigid body that elements touch: laws/linear_contact.hpp. How it moves is given, but along the
/// axis of a drive.
///
/// The contacts of new poses are found after each move (`look`); their forces act in the next step,
/// and observers see them as they are. Elements that may touch stand in a list with a skin, made
/// anew when elements and tool may have moved through it; what the tool touches does not depend on
/// when that is. An element that overlaps the tool a little where a run begins touches it where it
/// stands.
class Tool : public Effect, public TouchesElements {
 public:
  /// Throws InputError when the tool begins deep inside of the body. `stiffness`: k_n, N/m.
  Tool(std::string name, std::unique_ptr<RigidShape> shape, const RigidPose& start,
       const ToolMotion& motion, const ToolContact& contact, double stiffness, const Model& model);

  void advance(Model& model, const Step& step) override;
  /// Finds the contacts of the poses after a step. `imposed`: elements whose motion grips impose.
  void look(Model& model, const Step& step, const std::vector<char>& imposed);
  /// From now on what its contacts lose is entered as heat of elements (columns::friction_heat) and
  /// its own.
  void warm(const ContactHeat& heat) { contact_heat_ = &heat; }

  void observe(const Model& model, Observation& observation) const override;
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  double added_squared_frequency() const override;
  double work(const Model& /*model*/) const override { return work_; }
  void state(Archive& archive) override;
  void show(const Model& model, Frame& frame) const override;
  void summarise(const Model& model, Summary& summary) const override;

  const std::string& name() const { return name_; }
  /// What other codes must know of it, in SI units: shape, contact, motion, and how many elements
  /// touch it from the start on.
  Summary explanation() const;
  /// Its surface where it is; of a plane a square that is larger than the body.
  TriangleMesh surface(const Model& model) const;
  RigidPose pose() const { return moved(start_, motion_, displacement_, angle_); }
  /// Of the tool, K; none: no heat passes where elements touch it.
  const std::optional<TimeFunction>& temperature() const { return contact_.temperature; }
  /// Calls visit(element, overlap) for each place where it is touched, by element; m.
  template <class Visit>
  void for_each_touch(const Visit& visit) const {
    for (const Candidate& candidate : candidates_)
      for (const Touch& touch : candidate.touches) visit(candidate.element, touch.overlap);
  }
  void for_each_touched(const Visit& visit) const override;
  /// How often candidates were sought.
  std::size_t searches() const { return searches_; }
  /// Elements that it touches.
  std::vector<std::int32_t> touched() const;

 private:
  /// A place where an element touches.
  struct Touch {
    ContactHistory<double> history;
    double stored = 0;   ///< J
    double overlap = 0;  ///< m; found anew in each look

    void state(Archive& archive) {
      archive(history.normal, history.spring, history.dashpot, stored);
    }
  };
  /// An element that touches or may soon.
  struct Candidate {
    std::int32_t element = 0;
    double gap = 0;  ///< that tool and element must close before they touch, m
    NearFacets near;
    std::vector<Touch> touches;
    Vector force{}, moment{};          ///< on the element, about its centre
    SymmetricTensor<double> virial{};  ///< Σ sym(force ⊗ lever from its centre), N·m
    Vector on_tool{};                  ///< moment of the opposite about the tool's rotation point
    double friction = 0, damping = 0;  ///< J, dissipated in the last step

    void state(Archive& archive) {
      archive(element, touches, force, moment, virial.xx, virial.xy, virial.xz, virial.yy,
              virial.yz, virial.zz);
    }
  };
  /// How a rigid body moves from one pose to the next: the velocity of a point and the angular
  /// velocity, and where the point is in the end.
  struct Passage {
    Vector velocity, angular_velocity, point;
    Vector velocity_at(const Vector& place) const {
      return velocity + cross(angular_velocity, place - point);
    }
  };
  /// Columns of the elements, as they are at a look.
  struct Elements {
    Model::Rows<const double> position, position_before;
    const double *velocity, *spin;  ///< spin: null where elements do not turn
    const double* inverse_mass;

    Vector centre(std::size_t element) const {
      const double* row = position[element];
      return {row[0], row[1], row[2]};
    }
  };
  /// An element after a step.
  struct Passer {
    Passage passage;  ///< of its centre
    double inverse_mass;
    bool is_held;  ///< its motion is imposed
  };

  void fit_radii(const Model& model);
  /// Shares what contacts lost in a step.
  void share_heat(Model& model);
  void move(double time);
  /// How far the tool may have moved, m, where elements are, since candidates were sought.
  double moved_since_search() const;
  bool must_search(const Elements& elements, std::size_t count);
  void search(const Model& model);
  static Elements elements_of(Model& model);
  static Passer passer(const Elements& elements, std::size_t element, bool is_held,
                       double time_step);
  void meet(const Passer& passer, const RigidPose& pose, const Passage& passage, double time_step,
            Candidate& candidate) const;
  void press(const Passer& passer, const SurfacePoint& place, const Passage& passage,
             double time_step, const ContactHistory<double>& before, Candidate& candidate) const;
  LinearContact<double> contact_of(const Passer& passer) const;
  double inverse_mass() const { return motion_.drive ? 1 / motion_.drive->mass : 0; }
  /// The largest k / m of one contact, 1/s².
  double stiffness_over_mass() const;
  void insist_on_stable_drive(const Step& step) const;

  std::string name_;
  std::unique_ptr<RigidShape> shape_;
  RigidPose start_;
  ToolMotion motion_;
  ToolContact contact_;
  double stiffness_, tangential_stiffness_, damping_ratio_;
  double largest_inverse_mass_;  ///< of the elements, 1/kg
  std::vector<double> radius_;   ///< of the elements as the tool feels them, m
  std::size_t fitted_ = 0;       ///< elements that overlapped at the start
  double deepest_fitted_ = 0;    ///< m
  double skin_;                  ///< m
  double watch_;                 ///< m, beyond the skin: elements there are looked at each step

  std::vector<Candidate> candidates_;  ///< by element
  std::vector<std::int32_t> watched_;  ///< elements in the skin or not far from it
  int steps_since_look_ = 0;           ///< at all others
  std::vector<Vector> listed_at_;      ///< where elements stood when candidates were sought
  Vector listed_displacement_{};       ///< and the tool
  double listed_angle_ = 0;
  double listed_reach_ = 0;  ///< from the axis, of what turns and may touch elements, m
  bool is_listed_ = false;
  std::size_t searches_ = 0;

  Vector displacement_{};          ///< m, from the start
  double angle_ = 0;               ///< rad
  double travel_ = 0, speed_ = 0;  ///< of a drive along its axis; half a step behind: m, m/s
  Vector force_{}, torque_{};      ///< on the tool, of its contacts; about the rotation point
  double stored_ = 0;              ///< J
  double friction_ = 0, damping_ = 0, work_ = 0;  ///< since the start, J
  const ContactHeat* contact_heat_ = nullptr;     ///< null: its contacts make none
  double heat_ = 0;                               ///< that it was given since the start, J
};

}  // namespace solidem

#endif
