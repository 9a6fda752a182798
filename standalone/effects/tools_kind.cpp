// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[tools]]: rigid bodies that elements touch.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/contact_conduction.hpp"
#include "effects/effect_kind.hpp"
#include "effects/free_motion.hpp"
#include "effects/friction_heat.hpp"
#include "effects/grips.hpp"
#include "effects/mechanics.hpp"
#include "effects/tools.hpp"
#include "keys/mesh_file.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"
#include "output/digest.hpp"

namespace solidem {

namespace {

enum class ToolShape { plane, box, sphere, cylinder, mesh };

struct ToolParameters {
  std::string name;
  ToolShape shape = ToolShape::plane;
  Vector origin{};
  Vector normal{0, 0, 1}, axis{0, 0, 1};  ///< of a plane and a cylinder
  double radius = 0, length = 0;          ///< of a sphere and a cylinder, m
  Vector size{};                          ///< of a box, m
  std::string file;                       ///< of a mesh
  double unit = 0;                        ///< of its file, m
  TriangleMesh mesh;                      ///< m; as read, in the file's unit
  Vector tilt_axis{0, 0, 1};
  double tilt_angle = 0;  ///< rad
  ToolMotion motion;
  ToolDrive drive;
  ToolContact contact;
  TimeFunction temperature;                                    ///< K
  std::optional<double> conductivity, density, specific_heat;  ///< W/(m K), kg/m³, J/(kg K)
};

/// As a tool that takes its share of the heat of friction must name.
const std::vector<std::string> thermal_keys = {"conductivity", "density", "specific_heat_capacity"};

/// Finds the contacts of all tools after each move.
class ToolContacts : public Effect {
 public:
  ToolContacts(std::vector<Tool*> tools, const std::vector<Grip*>& grips, std::size_t elements)
      : tools_(std::move(tools)), imposed_(elements, 0) {
    for (const Grip* grip : grips)
      for (const std::int32_t element : grip->elements())
        for (int axis = 0; axis < 3; ++axis)
          if (grip->imposed(axis)) imposed_[static_cast<std::size_t>(element)] = 1;
  }

  void advance(Model& model, const Step& step) override {
    for (Tool* tool : tools_) tool->look(model, step, imposed_);
  }

 private:
  std::vector<Tool*> tools_;
  std::vector<char> imposed_;  ///< elements that grips move
};

Rule mesh_file(ToolParameters& p) {
  const Rule file = path(p.file);
  return {file.expected, [&p, file](const Value& value) {
            file.read(value);
            try {
              p.mesh = read_mesh(p.file, 1);
            } catch (const InputError& error) {
              value.refuse(error.what(), "a mesh whose facets make a surface");
            }
            Digest digest;
            digest.add(p.mesh.vertices);
            value.note("mesh " + digest.hexadecimal());
          }};
}

Rule along_axes(std::array<TimeFunction, 3>& target, const Dimension& dimension) {
  return triple(describe(dimension, anything) + ", or a function of time",
                [&target, dimension](const Value& entry, int k) {
                  target[static_cast<std::size_t>(k)] = read_function(entry, dimension, anything);
                });
}

std::vector<Key> keys_of_shape_and_motion(ToolParameters& p, Reading& reading) {
  using Shape = ToolShape;
  const Rule way = {"a table {time, position}",
                    [&p](const Value& value) { p.motion.along = read_path(Section(value)); }};
  return {
      must_have("name", name(p.name, reading.taken)).means("names the columns `tool.NAME.…`"),
      must_have("shape", choice<Shape>(p.shape, {{"plane", Shape::plane},
                                                 {"box", Shape::box},
                                                 {"sphere", Shape::sphere},
                                                 {"cylinder", Shape::cylinder},
                                                 {"mesh", Shape::mesh}})),
      may_have("origin", vector(p.origin, dimension::length))
          .means("a point of a plane; the middle of a box, sphere or cylinder; where a mesh's own "
                 "origin comes to stand")
          .without("zero"),
      may_have("normal", direction(p.normal))
          .means("of a plane, towards the body")
          .without("`[0, 0, 1]`"),
      may_have("size", vector(p.size, dimension::length, positive))
          .means("of a box")
          .without("needed with a box"),
      may_have("radius", quantity(p.radius, dimension::length, positive))
          .means("of a sphere or cylinder")
          .without("needed with these"),
      may_have("length", quantity(p.length, dimension::length, positive))
          .means("of a cylinder")
          .without("needed with it"),
      may_have("axis", direction(p.axis)).means("of a cylinder").without("`[0, 0, 1]`"),
      may_have("file", mesh_file(p))
          .means("of a mesh: .stl, .obj or .ply")
          .without("needed with a mesh"),
      may_have("unit", quantity(p.unit, dimension::length, positive))
          .means("of the lengths in the file")
          .without("needed with a mesh"),
      may_have("tilt_axis", direction(p.tilt_axis))
          .means("of a box or mesh that stands askew")
          .without("it stands upright"),
      may_have("tilt_angle", quantity(p.tilt_angle, dimension::angle))
          .means("by which it is turned about that axis through its origin"),
      may_have("velocity", along_axes(p.motion.along, dimension::velocity)).without("it stands"),
      may_have("path", way)
          .means("of the tool's origin, linear between the times, held outside: the way from its "
                 "first place counts")
          .without("or this"),
      may_have("force", function(p.drive.force, dimension::force))
          .means("that drives the tool along force_axis, against mass and contacts")
          .without("or this"),
      may_have("force_axis", direction(p.drive.axis)).without("needed with force"),
      may_have("mass", quantity(p.drive.mass, dimension::mass, positive))
          .without("needed with force"),
      may_have("angular_velocity", function(p.motion.angular_velocity, dimension::angular_velocity))
          .without("it does not turn"),
      may_have("rotation_axis", direction(p.motion.rotation_axis))
          .without("needed with angular_velocity"),
      may_have("rotation_point", vector(p.motion.rotation_point, dimension::length))
          .means("of that axis, at the start: it goes where the tool goes")
          .without("origin"),
      may_have("stiffness", quantity(p.contact.stiffness, dimension::stiffness, positive))
          .means("k_n of a contact")
          .without("by stiffness_ratio"),
      may_have("stiffness_ratio", number(p.contact.stiffness_ratio, positive))
          .means("k_n over the mean stiffness of the bonds, E S / l, of the central law, or of "
                 "contacts of "
                 "loose elements"),
      may_have("tangential_ratio", number(p.contact.tangential_ratio, positive))
          .means("k_t / k_n, where there is friction"),
      may_have("friction", number(p.contact.friction, not_negative)).means("Coulomb's coefficient"),
      may_have("restitution", number(p.contact.restitution, Range{0, 1, false, true}))
          .means("coefficient, of an element alone against the tool")};
}

std::vector<Key> tool_keys(ToolParameters& p, Reading& reading) {
  std::vector<Key> keys = keys_of_shape_and_motion(p, reading);
  keys.push_back(
      may_have("conductivity", quantity(p.conductivity, dimension::conductivity, positive))
          .means("of the tool, by which it shares the heat of friction; with `[friction_heat]`")
          .without("all heat of friction goes into elements"));
  keys.push_back(may_have("density", quantity(p.density, dimension::density, positive))
                     .means("likewise")
                     .without("needed with conductivity"));
  keys.push_back(may_have("specific_heat_capacity",
                          quantity(p.specific_heat, dimension::specific_heat_capacity, positive))
                     .means("likewise")
                     .without("needed with conductivity"));
  keys.push_back(
      may_have("temperature", function(p.temperature, dimension::temperature, not_negative))
          .means("of the tool, which elements that touch it exchange heat with; with "
                 "`[contact_conduction]`")
          .without("no heat passes"));
  return keys;
}

/// Keys that belong to one shape, or to some, are needed with them or may be there; with others
/// they are refused.
void check_shape(const Section& section, ToolShape shape) {
  using Shape = ToolShape;
  struct Belonging {
    const char* key;
    std::vector<Shape> to;
    bool is_needed;
    const char* whose;
  };
  const Belonging belongings[] = {
      {"normal", {Shape::plane}, false, "a plane"},
      {"size", {Shape::box}, true, "a box"},
      {"radius", {Shape::sphere, Shape::cylinder}, true, "a sphere or cylinder"},
      {"length", {Shape::cylinder}, true, "a cylinder"},
      {"axis", {Shape::cylinder}, false, "a cylinder"},
      {"file", {Shape::mesh}, true, "a mesh"},
      {"unit", {Shape::mesh}, true, "a mesh"},
      {"tilt_axis", {Shape::box, Shape::mesh}, false, "a box or mesh"},
      {"tilt_angle", {Shape::box, Shape::mesh}, false, "a box or mesh"}};
  for (const Belonging& one : belongings) {
    const bool belongs = std::find(one.to.begin(), one.to.end(), shape) != one.to.end();
    if (section.has(one.key) && !belongs)
      section.refuse(one.key, "belongs to another shape", std::string("it with ") + one.whose);
    if (!section.has(one.key) && belongs && one.is_needed)
      section.refuse(std::string("\"") + one.key + "\" is missing",
                     std::string(one.key) + " of " + one.whose);
  }
}

void insist_on(const Section& section, const std::string& given, const std::string& needed) {
  if (section.has(given) && !section.has(needed))
    section.refuse("\"" + needed + "\" is missing", needed + " beside " + given);
}

void finish_tool(const Section& section, ToolParameters& p, Reading& /*reading*/) {
  check_shape(section, p.shape);
  section.at_most_one_of({"velocity", "path", "force"});
  section.at_most_one_of({"stiffness", "stiffness_ratio"});
  insist_on(section, "force", "force_axis");
  insist_on(section, "force", "mass");
  insist_on(section, "force_axis", "force");
  insist_on(section, "mass", "force");
  insist_on(section, "angular_velocity", "rotation_axis");
  insist_on(section, "rotation_axis", "angular_velocity");
  insist_on(section, "rotation_point", "angular_velocity");
  insist_on(section, "tilt_axis", "tilt_angle");
  insist_on(section, "tilt_angle", "tilt_axis");
  for (const std::string& given : thermal_keys)
    for (const std::string& needed : thermal_keys) insist_on(section, given, needed);
  if (section.has("temperature")) p.contact.temperature = p.temperature;
  if (p.conductivity)
    p.contact.effusivity = effusivity_of(*p.conductivity, *p.density, *p.specific_heat);
  if (!section.has("rotation_point")) p.motion.rotation_point = p.origin;
  p.motion.is_path = section.has("path");
  if (section.has("force")) p.motion.drive = p.drive;
  for (Vector& vertex : p.mesh.vertices) vertex = p.unit * vertex;
}

std::unique_ptr<RigidShape> shape_of(const ToolParameters& p) {
  switch (p.shape) {
    case ToolShape::plane:
      return plane_shape();
    case ToolShape::box:
      return box_shape(p.size);
    case ToolShape::sphere:
      return ball_shape(p.radius);
    case ToolShape::cylinder:
      return cylinder_shape(p.radius, p.length);
    case ToolShape::mesh:
      break;
  }
  return mesh_shape(p.mesh);
}

RigidPose start_of(const ToolParameters& p) {
  switch (p.shape) {
    case ToolShape::plane:
      return {p.origin, rotation_of_z(p.normal)};
    case ToolShape::cylinder:
      return {p.origin, rotation_of_z(p.axis)};
    default:
      return {p.origin, rotation_about(p.tilt_axis, p.tilt_angle)};
  }
}

/// A mesh so much larger or smaller than the body was meant in another unit.
void check_unit(const ToolParameters& p, const Specimen& specimen) {
  constexpr double too_large = 300, too_small = 0.1;  // of the body, of an element
  const auto largest_of = [](const Vector& size) { return std::max({size.x, size.y, size.z}); };
  const auto [lower, upper] = bounds(p.mesh);
  const double mesh = largest_of(upper - lower);
  const double body = largest_of(specimen.domain.upper - specimen.domain.lower);
  const double element = mean_radius(specimen);
  if (mesh > too_large * body)
    throw InputError(fmt::format(
        "[[tools]] \"{}\": {} is {} m large, {} times the body; expected another unit (unit = {} m "
        "now)",
        p.name, p.file, text(mesh), text(mesh / body), text(p.unit)));
  if (mesh < too_small * element)
    throw InputError(fmt::format(
        "[[tools]] \"{}\": {} is {} m large, {} of an element's radius; expected another unit "
        "(unit = {} m now)",
        p.name, p.file, text(mesh), text(mesh / element), text(p.unit)));
}

double stiffness_of(const ToolParameters& p, const Assembly& assembly) {
  if (p.contact.stiffness) return *p.contact.stiffness;
  const double of_bonds = assembly.need<Mechanics>().mean_stiffness(assembly.model);
  if (!(of_bonds > 0))
    throw InputError("[[tools]] \"" + p.name +
                     "\": the body has nothing whose stiffness a contact could have a ratio of; "
                     "expected stiffness, such as \"1500 kN/m\"");
  return p.contact.stiffness_ratio * of_bonds;
}

std::unique_ptr<Effect> make_tool(const ToolParameters& p, Assembly& assembly) {
  const Specimen& specimen = assembly.specimen();
  if (specimen.domain.is_periodic())
    throw InputError("[[tools]] \"" + p.name +
                     "\": a tool would touch a periodic body in one of its images alone; expected "
                     "a body without periodic directions");
  if (p.shape == ToolShape::mesh) check_unit(p, specimen);
  return std::make_unique<Tool>(p.name, shape_of(p), start_of(p), p.motion, p.contact,
                                stiffness_of(p, assembly), assembly.model);
}

/// What tools say of heat must mean something.
void check_heat(const Setup& setup, const std::vector<ToolParameters>& tools) {
  for (const ToolParameters& tool : tools) {
    const std::string name = "[[tools]] \"" + tool.name + "\": ";
    if (tool.contact.effusivity > 0 && !setup.get<FrictionHeatParameters>())
      throw InputError(name +
                       "conductivity, density and specific_heat_capacity say how much of the heat "
                       "of friction it takes, and there is none; expected a section "
                       "[friction_heat], or none of the three");
    if (tool.contact.temperature && !setup.get<ContactConductionParameters>())
      throw InputError(name +
                       "temperature: no heat passes where elements touch it; expected a section "
                       "[contact_conduction], or no temperature");
  }
  if (setup.get<ContactConductionParameters>() && !setup.get<ContactParameters>() &&
      std::none_of(tools.begin(), tools.end(),
                   [](const ToolParameters& tool) { return tool.contact.temperature; }))
    throw InputError(
        "[contact_conduction] elements do not touch each other, and no tool has a temperature; "
        "expected temperature in [[tools]], or a section [contact]");
}

void plan_tools(const Setup& setup, Plan& plan) {
  const std::vector<ToolParameters>& tools = setup.all<ToolParameters>();
  for (const ToolParameters& tool : tools)
    plan.effects.push_back({"tool " + tool.name, "[[tools]]", "", Phase::push,
                            [tool](Assembly& assembly) { return make_tool(tool, assembly); }});
  if (tools.empty()) return;
  check_heat(setup, tools);
  if (elements_are_loose(setup) && std::any_of(tools.begin(), tools.end(), [](const auto& tool) {
        return tool.contact.friction > 0;
      }))
    plan.ask("contacts of tools", {&columns::angular_velocity, &columns::inverse_inertia});
  plan.effects.push_back(
      {"contacts of tools", "[[tools]]", "", Phase::after_move, [](Assembly& assembly) {
         return std::make_unique<ToolContacts>(assembly.all<Tool>(), assembly.all<Grip>(),
                                               assembly.model.elements());
       }});
}

}  // namespace

EffectKind tools_kind() {
  EffectKind kind = list_kind<ToolParameters>("tools", tool_keys, finish_tool);
  kind.needs = Provides::motion;
  kind.plan = plan_tools;
  kind.example =
      "[[tools]]\n"
      "name = \"floor\"\n"
      "shape = \"plane\"\n"
      "origin = [\"0 mm\", \"0 mm\", \"-0.01 mm\"]\n"
      "velocity = [\"0 m/s\", \"0 m/s\", \"30 m/s\"]\n"
      "friction = 0.3\n"
      "restitution = 0.8\n";
  return kind;
}

}  // namespace solidem
