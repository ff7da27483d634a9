// Where the library's own data lie: styles, and tables of land cover.
#pragma once

namespace oro {

// Points data_folder() at share/orograph of the folder tree that the library's file lies in: of an
// installation (lib/liborograph.so.0, or lib/x86_64-linux-gnu/ of Debian) or of a build. Once; safe from any
// thread. Where there is none the program's rule stays.
void find_library_data();

}  // namespace oro
