#define _XOPEN_SOURCE 700

#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"

// What ends a run, and what tells that a child has ended.
static sigset_t held_signals(void)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP);
    sigaddset(&set, SIGCHLD);
    return set;
}

void child_hold_signals(void)
{
    const sigset_t set = held_signals();
    sigprocmask(SIG_BLOCK, &set, NULL);
}

static bool redirect(const char *path, int flags, int to)
{
    const int file = open(path, flags, 0666);
    return file >= 0 && dup2(file, to) >= 0;
}

// In the new process, up to the program; returns where that failed. What is broken is told by `pipe`, which
// closes by itself where all is well.
static void become(const Child *child, int pipe)
{
    const sigset_t set = held_signals();
    sigprocmask(SIG_UNBLOCK, &set, NULL);
    bool ok = redirect(child->talk_path, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO) &&
              redirect("/dev/null", O_WRONLY, STDOUT_FILENO) &&
              redirect("/dev/null", O_RDONLY, STDIN_FILENO) && (!child->folder || chdir(child->folder) == 0);
    for (const char *const *entry = child->environment; ok && entry && *entry; entry++)
        ok = putenv((char *)(uintptr_t)*entry) == 0;
    if (ok)
        execvp(child->argv[0], (char *const *)(uintptr_t)child->argv);
    const int reason = errno;
    if (write(pipe, &reason, sizeof reason) != sizeof reason)
        _exit(126);
}

// Until the child has ended; false where we were asked to end before.
static bool wait_for(pid_t process, int *status)
{
    const sigset_t set = held_signals();
    bool asked = false;
    while (waitpid(process, status, WNOHANG) == 0) {
        int number;
        if (sigwait(&set, &number) != 0 || number == SIGCHLD)
            continue;
        asked = true;
        kill(process, SIGTERM);
    }
    return !asked;
}

static void read_talk(const char *path, char *talk)
{
    FILE *file = fopen(path, "rb");
    size_t length = file ? fread(talk, 1, CHILD_TALK_BYTES - 1, file) : 0;
    if (file)
        fclose(file);
    while (length > 0 && talk[length - 1] == '\n')
        length--;
    talk[length] = 0;
}

static bool asked_to_end(void)
{
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGINT) || sigismember(&pending, SIGTERM) || sigismember(&pending, SIGHUP);
}

bool child_run(const Child *child, ChildEnd *end, Error *error)
{
    int ends[2];
    if (asked_to_end())
        return error_set(error, ERROR_INTERRUPTED, "interrupted");
    child_hold_signals(); // that of the child's end is waited for
    if (pipe(ends) != 0)
        return error_set(error, ERROR_IO, "%s: %s", child->argv[0], strerror(errno));
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    fflush(NULL);
    const f64 start = clock_seconds();
    const pid_t process = fork();
    if (process == 0) {
        become(child, ends[1]);
        _exit(127);
    }
    close(ends[1]);
    int reason = process < 0 ? errno : 0;
    if (process > 0 && read(ends[0], &reason, sizeof reason) != sizeof reason)
        reason = 0;
    close(ends[0]);
    int status = 0;
    const bool left_alone = process < 0 || wait_for(process, &status);
    end->seconds = clock_seconds() - start;
    if (reason)
        return error_set(error, ERROR_IO, "%s: %s", child->argv[0], strerror(reason));
    if (!left_alone)
        return error_set(error, ERROR_INTERRUPTED, "interrupted");
    end->status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    read_talk(child->talk_path, end->talk);
    return true;
}
