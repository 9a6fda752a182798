// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[sensors]], [gauge], [run] and [output].
#include <memory>

#include "effects/effect_kind.hpp"
#include "engine/frame_fields.hpp"
#include "keys/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

Rule sensors_section(std::vector<Sensor>& sensors, NamedEffects effects) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&sensors, effects, taken](const Section& section) {
    using Quantity = Sensor::Quantity;
    using Sampling = Sensor::Sampling;
    Sensor sensor;
    section.read(
        {must_have("name", name(sensor.name, *taken)),
         must_have("point", vector(sensor.point, dimension::length)),
         must_have("quantity",
                   choice<Quantity>(sensor.quantity, {{"temperature", Quantity::temperature},
                                                      {"position", Quantity::position},
                                                      {"displacement", Quantity::displacement},
                                                      {"velocity", Quantity::velocity}})),
         may_have("sampling", choice<Sampling>(sensor.sampling, {{"nearest", Sampling::nearest},
                                                                 {"fit", Sampling::fit}}))});
    const bool is_thermal = sensor.quantity == Quantity::temperature;
    if (is_thermal ? !effects.heat : !effects.motion)
      section.refuse("quantity", is_thermal ? "nothing conducts heat" : "nothing moves",
                     sections_that_provide({is_thermal ? Provides::heat : Provides::motion}));
    sensors.push_back(sensor);
  });
}

Rule gauge_section(std::optional<Gauge>& gauge) {
  return table([&gauge](const Section& section) {
    Gauge read;
    section.read({must_have("axis", axis(read.axis)),
                  must_have("lower", quantity(read.lower, dimension::length)),
                  must_have("upper", quantity(read.upper, dimension::length))});
    if (read.upper <= read.lower) section.refuse("upper", "not above lower", "upper > lower");
    gauge = read;
  });
}

Rule run_section(RunControl& run) {
  return table([&run](const Section& section) {
    section.read({may_have("duration", quantity(run.duration, dimension::time, positive)),
                  may_have("steps", integer(run.steps, 1)),
                  may_have("time_step", quantity(run.time_step, dimension::time, positive)),
                  may_have("time_step_ratio", number(run.time_step_ratio, positive)),
                  may_have("observe_every", integer(run.observe_every, 1))});
    section.exactly_one_of({"duration", "steps"});
    section.at_most_one_of({"time_step", "time_step_ratio"});
    if (run.duration && run.time_step && *run.time_step > *run.duration)
      section.refuse("time_step", "longer than the duration", "time_step <= duration");
  });
}

Rule output_section(OutputControl& output) {
  std::vector<std::string> names;
  for (const FieldName& field : frame_field_names()) names.push_back(field.name);
  return table([&output, names](const Section& section) {
    section.read({may_have("frames", integer(output.frames, 0, 1000000)),
                  may_have("checkpoint_every", integer(output.checkpoint_every, 0)),
                  may_have("fields", words(output.fields, names))});
    if (!output.fields.empty() && output.frames == 0)
      section.refuse("fields", "there are no frames to show them", "frames above 0");
  });
}

}  // namespace solidem
