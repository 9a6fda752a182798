// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_REPLACE_FILE_HPP
#define SOLIDEM_OUTPUT_REPLACE_FILE_HPP

#include <string>
#include <string_view>
#include <vector>

namespace solidem {

/// Writes a file so that `path` holds either the old content or all of the new, whatever fails and
/// whenever the program is killed. The parts, one behind the other, go to a new file beside it,
/// which takes the place of `path` once its bytes are on the disk. RunError names `path` and the
/// reason; then the old file stays and the new one is gone. What a killed program left of it does
/// not stand in the way; what another program is writing does.
void replace_file(const std::string& path, const std::vector<std::string_view>& parts);

/// The same for text. A device or a pipe (/dev/stdout) is written to directly.
void replace_text_file(const std::string& path, const std::string& text);

}  // namespace solidem

#endif
