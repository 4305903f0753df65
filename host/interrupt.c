#include "interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"

static const long PATIENCE = 500 * 1000 * 1000; // nanoseconds
static const int WAKE = SIGUSR1; // sent by interrupt_stop, so that the thread ends

struct Interrupt {
    pthread_t thread;
    sigset_t signals; // waited for
    atomic_bool requested;
    pthread_mutex_t mutex; // of what follows
    pthread_cond_t changed;
    bool stopped;
    char *temporary;
};

// WAKE, and those signals that the program was not started to ignore (nohup, a shell's background jobs).
static void collect_signals(sigset_t *signals)
{
    static const int NUMBERS[] = {SIGINT, SIGTERM, SIGHUP};
    sigemptyset(signals);
    sigaddset(signals, WAKE);
    for (size_t i = 0; i < sizeof NUMBERS / sizeof NUMBERS[0]; i++) {
        struct sigaction action;
        if (sigaction(NUMBERS[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN)
            sigaddset(signals, NUMBERS[i]);
    }
}

static void *wait_for_signals(void *context)
{
    Interrupt *interrupt = context;
    int number;
    if (sigwait(&interrupt->signals, &number) != 0 || number == WAKE)
        return NULL;
    atomic_store(&interrupt->requested, true);
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += PATIENCE;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_mutex_lock(&interrupt->mutex);
    while (!interrupt->stopped && pthread_cond_timedwait(&interrupt->changed, &interrupt->mutex, &until) == 0)
        continue;
    if (!interrupt->stopped) {
        if (interrupt->temporary)
            unlink(interrupt->temporary);
        static const char WORD[] = "\nclrt: interrupted\n";
        const ssize_t written = write(STDERR_FILENO, WORD, sizeof WORD - 1);
        (void)written; // nothing is left to be done about it
        _exit(ERROR_INTERRUPTED);
    }
    pthread_mutex_unlock(&interrupt->mutex);
    return NULL;
}

static bool init_changed(pthread_cond_t *changed)
{
    pthread_condattr_t attributes;
    if (pthread_condattr_init(&attributes) != 0)
        return false;
    const bool ok = pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) == 0 &&
                    pthread_cond_init(changed, &attributes) == 0;
    pthread_condattr_destroy(&attributes);
    return ok;
}

Interrupt *interrupt_start(void)
{
    Interrupt *interrupt = calloc(1, sizeof *interrupt);
    if (!interrupt)
        return NULL;
    collect_signals(&interrupt->signals);
    pthread_mutex_init(&interrupt->mutex, NULL);
    if (!init_changed(&interrupt->changed)) {
        free(interrupt);
        return NULL;
    }
    sigset_t before;
    pthread_sigmask(SIG_BLOCK, &interrupt->signals, &before);
    if (pthread_create(&interrupt->thread, NULL, wait_for_signals, interrupt) != 0) {
        pthread_sigmask(SIG_SETMASK, &before, NULL);
        pthread_cond_destroy(&interrupt->changed);
        free(interrupt);
        return NULL;
    }
    return interrupt;
}

bool interrupt_requested(const Interrupt *interrupt)
{
    return interrupt && atomic_load(&interrupt->requested);
}

void interrupt_set_temporary(Interrupt *interrupt, const char *path)
{
    if (!interrupt)
        return;
    char *copy = path ? strdup(path) : NULL;
    pthread_mutex_lock(&interrupt->mutex);
    char *old = interrupt->temporary;
    interrupt->temporary = copy;
    pthread_mutex_unlock(&interrupt->mutex);
    free(old);
}

void interrupt_stop(Interrupt *interrupt)
{
    if (!interrupt)
        return;
    pthread_mutex_lock(&interrupt->mutex);
    interrupt->stopped = true;
    pthread_cond_signal(&interrupt->changed);
    pthread_mutex_unlock(&interrupt->mutex);
    pthread_kill(interrupt->thread, WAKE);
    pthread_join(interrupt->thread, NULL);
    pthread_cond_destroy(&interrupt->changed);
    pthread_mutex_destroy(&interrupt->mutex);
    free(interrupt->temporary);
    free(interrupt);
}
