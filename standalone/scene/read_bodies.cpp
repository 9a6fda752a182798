// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[body]]: a specimen of several bodies.
#include "keys/rules.hpp"
#include "keys/turn.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Rule names(std::vector<std::string>& target) {
  const std::string expected = "an array of names of bodies";
  return {expected, [&target, expected](const Value& value) {
            for (const Value& entry : value.entries(-1, expected))
              target.push_back(read_text(entry, "the name of a body"));
          }};
}

}  // namespace

Rule bodies_section(std::vector<BodyRecipe>& bodies, const std::string& scene_file) {
  return tables([&bodies, scene_file](const Section& section) {
    std::set<std::string> taken;
    for (const BodyRecipe& body : bodies) taken.insert(body.name);
    BodyRecipe body;
    read_specimen(
        section, body.recipe, scene_file,
        {must_have("name", name(body.name, taken)), may_have("orientation", turn(body.turned)),
         may_have("shift", vector(body.shift, dimension::length)),
         may_have("bonded_to", names(body.bonded_to))});
    bodies.push_back(std::move(body));
  });
}

}  // namespace solidem
