// SPDX-License-Identifier: GPL-2.0-or-later
//
// The rooms below know nothing of files: what they refuse begins with the name of what made it,
// `[specimen] mean_radius = …`, `[[grips]] "left" region: …`. Where that stands is added here.
#ifndef SOLIDEM_SCENE_PLACES_HPP
#define SOLIDEM_SCENE_PLACES_HPP

#include <toml++/toml.h>

#include <map>
#include <string>

namespace solidem {

/// Where the sections and keys of a scene file stand.
class Places {
 public:
  Places() = default;
  Places(const toml::table& file, const std::string& path);

  /// A message with file and line before it: those of the longest name of a section or key that it
  /// begins with. One about a section that the file does not have gets the file alone; others stay
  /// as they are.
  std::string located(const std::string& message) const;

 private:
  void add_keys(const toml::table& table, const std::string& name);
  void add_section(const toml::node& node, const std::string& name);
  void add(const toml::node& node, const std::string& name);

  std::string path_;
  std::map<std::string, std::string> place_;  ///< of each name
};

}  // namespace solidem

#endif
