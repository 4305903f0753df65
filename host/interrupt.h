// Interrupt: what SIGINT, SIGTERM and SIGHUP do to a run. A thread of its own waits for them, so that they
// are answered within a second whatever the main thread is in, the compiler of a driver for one. Stands
// beside main.c, outside the modules, because it may end the program.
#ifndef CLRT_INTERRUPT_H
#define CLRT_INTERRUPT_H

#include <stdbool.h>

typedef struct Interrupt Interrupt;

// To be called before any other thread exists: all inherit that the signals are blocked. Signals that were
// ignored when the program began stay ignored. Returns NULL, with signals as they were, where there is no
// memory or no thread for it; the other functions take NULL.
Interrupt *interrupt_start(void);

// True once a signal came. The main thread then has half a second to give up in good order and to call
// interrupt_stop; after that the temporary file is removed and the program ends with status 130.
bool interrupt_requested(const Interrupt *interrupt);

// The file to remove in that case (copied), or NULL for none.
void interrupt_set_temporary(Interrupt *interrupt, const char *path);

// From here on signals change nothing: the exit status is decided. Frees the Interrupt.
void interrupt_stop(Interrupt *interrupt);

#endif
