// The files that a run of the program reads: what they were when they were opened, so that one which changes
// while it is read, and one that is to be replaced by what is made of it, are told.
#pragma once

#include <sys/stat.h>

#include <string>

#include "core/base/result.h"

namespace oro {

// From now on files that are opened for reading are remembered. Until it is called nothing is: a program that
// reads and writes the same files over and over (a test) is not watched. To be called before any thread is
// started.
void remember_files_read();

// From now on nothing more is remembered, and what was is forgotten: all that a run is about has been read,
// and what is read from now on are files that it makes itself.
void forget_files_read();

// From now on the file `path` is as if it had never been read: for one that the program has made itself, in
// this run or an earlier one, and that it may make again.
void forget_file_read(const std::string& path);

// For what opens files, before it reads: what the system says of the regular file `path` (others are passed
// over). Of one that was changed in the last moments, whose next change the system's clock might not tell
// from this one, the answer is waited for, some hundredths of a second. From any thread.
void remember_file_read(const std::string& path, const struct stat& found);

// That the files are what they were when they were first opened: the same file by that name, as long, and
// changed at the same time, to the nanosecond: by the time that programs may set, and by the system's own
// (new links and other rights are no change). Errors: the first that is not, and why; one that cannot be
// asked about.
Result<void> check_files_unchanged();

// That a file which is to be written is none that was read, by whatever name: links and letter case are seen
// through, for files are told by device and number. Errors: usage for one that was; failed for one that
// cannot be asked about.
Result<void> check_not_read(const std::string& target);

// The one exception: a picture that is drawn again from the view that it carries, into its own file.
void let_replace(const std::string& target);

}  // namespace oro
