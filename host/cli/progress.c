#include "cli/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/clock.h"

enum { LINE_MAX_LENGTH = 128, BAR_MAX = 40, BAR_MIN = 8, DEFAULT_WIDTH = 80 };

static const f64 FIRST_AFTER = 0.5, AGAIN_AFTER = 0.1; // seconds

static bool is_terminal(FILE *stream)
{
    const char *term = getenv("TERM");
    return isatty(fileno(stream)) && !(term && strcmp(term, "dumb") == 0);
}

static u32 terminal_width(FILE *stream)
{
    struct winsize size;
    return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : DEFAULT_WIDTH;
}

Progress progress_start(FILE *stream, bool quiet)
{
    return (Progress){.stream = !quiet && is_terminal(stream) ? stream : NULL, .start = clock_seconds()};
}

void progress_update(Progress *progress, f64 done, u64 rays)
{
    if (!progress->stream)
        return;
    const f64 now = clock_seconds();
    if (now - progress->start < FIRST_AFTER || now - progress->shown < AGAIN_AFTER)
        return;
    char line[LINE_MAX_LENGTH];
    progress_line(line, sizeof line, terminal_width(progress->stream) - 1, done, rays, now - progress->start);
    fprintf(progress->stream, "\r%s\033[K", line);
    fflush(progress->stream);
    progress->shown = now;
}

void progress_end(Progress *progress)
{
    if (!progress->stream || progress->shown == 0)
        return;
    fputs("\r\033[K", progress->stream);
    fflush(progress->stream);
    progress->shown = 0;
}

// "0:42", "1:02:03"
static void write_time(char *text, size_t size, f64 seconds)
{
    const u64 whole = (u64)(seconds + 0.5);
    const unsigned hours = (unsigned)(whole / 3600), minutes = (unsigned)(whole / 60 % 60);
    const unsigned rest = (unsigned)(whole % 60);
    if (hours > 0)
        snprintf(text, size, "%u:%02u:%02u", hours, minutes, rest);
    else
        snprintf(text, size, "%u:%02u", minutes, rest);
}

void progress_line(char *line, size_t size, u32 width, f64 done, u64 rays, f64 seconds)
{
    char left[32] = "", text[LINE_MAX_LENGTH];
    done = done < 0 ? 0 : done > 1 ? 1 : done;
    const f64 remaining = done > 0 ? seconds * (1 - done) / done : 0;
    if (done >= 0.01 && remaining < 3600 * 1000) {
        char time[24];
        write_time(time, sizeof time, remaining);
        snprintf(left, sizeof left, "  %s left", time);
    }
    const f64 rate = seconds > 0 ? (f64)rays / seconds * 1e-6 : 0;
    snprintf(text, sizeof text, "%3.0f %%  %.1f Mrays/s%s", floor(done * 100), rate, left);
    const size_t room = width < size ? width : size - 1;
    const size_t used = strlen(text);
    size_t bar = room > used + 3 ? room - used - 3 : 0;
    bar = bar > BAR_MAX ? BAR_MAX : bar;
    if (bar < BAR_MIN) {
        snprintf(line, room + 1, "%s", text);
        return;
    }
    char fill[BAR_MAX + 1];
    const size_t full = (size_t)(done * (f64)bar);
    memset(fill, ' ', bar);
    memset(fill, '=', full);
    if (full < bar)
        fill[full] = '>';
    fill[bar] = '\0';
    snprintf(line, size, "[%s] %s", fill, text);
}
