#pragma once

namespace duolux {

/// From now on Ctrl-C (SIGINT) and SIGTERM ask for a clean stop; a second Ctrl-C ends the program at once.
void catchInterrupts();

/// True once a stop has been asked for.
bool interrupted();

}  // namespace duolux
