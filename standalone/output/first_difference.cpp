// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/first_difference.hpp"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

namespace solidem {

namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;  // names and values

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  std::string line;
  while (std::getline(stream, line)) {
    const std::size_t end = line.find(" = ");
    if (end == std::string::npos)
      lines.emplace_back("", line);
    else
      lines.emplace_back(line.substr(0, end), line.substr(end + 3));
  }
  return lines;
}

/// A line as it stood; without the name where that is known.
std::string said(const std::pair<std::string, std::string>& line, const std::string& known = "") {
  return line.first == known ? line.second : line.first + " = " + line.second;
}

bool has_from(const Lines& lines, std::size_t start, const std::string& name) {
  return std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(std::min(start, lines.size())),
                     lines.end(), [&](const auto& line) { return line.first == name; });
}

}  // namespace

std::string first_difference(const std::string& first, const std::string& second) {
  const Lines a = lines_of(first), b = lines_of(second);
  for (std::size_t k = 0; k < a.size() || k < b.size(); ++k) {
    if (k < a.size() && k < b.size() && a[k] == b[k]) continue;
    if (k < a.size() && !has_from(b, k, a[k].first)) return said(a[k]) + ", not given";
    if (k < b.size() && !has_from(a, k, b[k].first))
      return b[k].first + " not given, not " + b[k].second;
    return said(a[k]) + ", not " + said(b[k], a[k].first);
  }
  return "";
}

}  // namespace solidem
