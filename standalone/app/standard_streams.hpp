// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_STANDARD_STREAMS_HPP
#define SOLIDEM_APP_STANDARD_STREAMS_HPP

namespace solidem {

/// Sees to it that the numbers of standard input, output and error are taken: else the first result
/// file would get the one that is free, and what is printed would land in it. And a reader that has
/// gone away (`| head`) is an error of a write, not the end of the program.
void secure_standard_streams();

/// An exit status, or 1 and a word on stderr if the standard output was not written whole.
int status_with_output(int status);

}  // namespace solidem

#endif
