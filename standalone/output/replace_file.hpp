// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_REPLACE_FILE_HPP
#define SOLIDEM_OUTPUT_REPLACE_FILE_HPP

#include <functional>
#include <string>

namespace solidem {

/// Writes a file so that `path` holds either the old content or all of the new: `write` is called
/// with the name of a temporary file beside it, which takes the place of `path` once its bytes are
/// on the disk. If `write` throws, the temporary file goes away, the old file stays, and the
/// exception passes on. Throws RunError when the directory is missing, `path` is a directory or a
/// device, or the file cannot be put in place.
void replace_file(const std::string& path,
                  const std::function<void(const std::string& temporary)>& write);

/// The same for text. A device or a pipe (/dev/stdout) is written to directly.
void replace_text_file(const std::string& path, const std::string& text);

}  // namespace solidem

#endif
