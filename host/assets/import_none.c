// A build without assimp.
#include "assets/import.h"

#include <string.h>

#ifndef CLRT_ASSIMP

bool import_available(void)
{
    return false;
}

bool import_read(const char *path, ImportFile *file, Error *error)
{
    (void)path;
    memset(file, 0, sizeof *file);
    return error_set(error, ERROR_SCENE, "this build reads OBJ alone; assimp was not there when it was made");
}

void import_destroy(ImportFile *file)
{
    memset(file, 0, sizeof *file);
}

#endif
