#include "assets/assimp.h"

#ifdef CLRT_ASSIMP

#include <dlfcn.h>
#include <string.h>

// ISO C has no cast from a pointer to data to one to a function; POSIX says that they look the same.
static bool find(const Assimp *assimp, const char *name, void *function)
{
    const void *symbol = dlsym(assimp->library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

bool assimp_open(Assimp *assimp, Error *error)
{
    // It stays when it is closed: loading it again would take as long as the first time.
    assimp->library = dlopen(CLRT_ASSIMP, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!assimp->library)
        return error_set(error, ERROR_SCENE, "cannot load assimp, which reads this format: %s", dlerror());
    if (find(assimp, "aiImportFile", &assimp->import_file) &&
        find(assimp, "aiReleaseImport", &assimp->release_import) &&
        find(assimp, "aiGetErrorString", &assimp->error_string) &&
        find(assimp, "aiGetMaterialColor", &assimp->material_color) &&
        find(assimp, "aiGetMaterialString", &assimp->material_string) &&
        find(assimp, "aiGetMaterialFloatArray", &assimp->material_numbers) &&
        find(assimp, "aiGetMaterialIntegerArray", &assimp->material_whole) &&
        find(assimp, "aiGetMaterialTexture", &assimp->texture))
        return true;
    dlclose(assimp->library);
    return error_set(error, ERROR_SCENE, "%s is not the assimp that this build was made for", CLRT_ASSIMP);
}

void assimp_close(Assimp *assimp)
{
    dlclose(assimp->library);
}

#endif
