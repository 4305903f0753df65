// clrt-report: how fast clrt renders scenes and how wrong the pictures are. Exit status as of clrt.
#include <stdio.h>

#include "arguments.h"
#include "report.h"

int main(int argc, char **argv)
{
    Arguments arguments;
    Error error = {.code = ERROR_NONE};
    Arena *arena = arena_create();
    bool ok = arena || error_set(&error, ERROR_MEMORY, "no memory");
    ok = ok && arguments_parse(argc, argv, arena, &arguments, &error);
    if (ok && arguments.errand == ERRAND_HELP)
        fputs(arguments_usage(), stdout);
    else if (ok && arguments.errand == ERRAND_VERSION)
        puts("clrt-report " CLRT_VERSION);
    else if (ok)
        ok = report_make(&arguments, argv[0], arena, &error);
    arena_destroy(arena);
    if (ok)
        return fflush(stdout) == 0 ? 0 : ERROR_IO;
    fprintf(stderr, "clrt-report: %s\n%s", error.text,
            error.code == ERROR_USAGE ? "Try clrt-report --help.\n" : "");
    return (int)error.code;
}
