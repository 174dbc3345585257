// Descriptors 0 to 2, however the process was started and whoever reads them.
#pragma once

namespace froxel::app {

// Those that are closed lead to /dev/null from now on, so that nothing else that is opened becomes
// one of them; and a reader that leaves is an error of a write, no signal. Before anything else is
// opened.
void holdStandardStreams();

// What was printed as a result, on its way. Throws StartupError (kIo): standard output took not all
// of it.
void finishResults();

} // namespace froxel::app
