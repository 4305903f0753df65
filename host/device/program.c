#include "device/program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/internal.h"

// The build log, NULL where there is none.
static char *read_log(const Program *program)
{
    size_t size = 0;
    const cl_device_id id = program->device->id;
    cl_int status = clGetProgramBuildInfo(program->program, id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = status == CL_SUCCESS ? calloc(size + 1, 1) : NULL;
    if (!log)
        return NULL;
    status = clGetProgramBuildInfo(program->program, id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    if (status != CL_SUCCESS)
        log[0] = '\0';
    return log;
}

// Where to begin so that the first error is seen however much stands before it.
static const char *first_error(const char *log)
{
    const char *error = strstr(log, "error");
    if (!error || error - log < 1024)
        return log;
    while (error > log && error[-1] != '\n')
        error--;
    return error;
}

static bool build(Program *program, const char *options, Error *error)
{
    Device *device = program->device;
    cl_int status;
    program->program =
        clCreateProgramWithSource(device->context, 1, &program->source, &program->length, &status);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateProgramWithSource", "%s", device->info.name);
    static const char FORMAT[] = "-cl-std=CL1.2 -cl-kernel-arg-info %s";
    const size_t size = sizeof FORMAT + strlen(options);
    program->options = malloc(size);
    if (!program->options)
        return error_set(error, ERROR_MEMORY, "no memory for the build options");
    snprintf(program->options, size, FORMAT, options);
    status = clBuildProgram(program->program, 1, &device->id, program->options, NULL, NULL);
    if (status != CL_SUCCESS) {
        char *log = read_log(program);
        status_error(error, status, "clBuildProgram", "%s:\n%s\noptions: %s", device->info.name,
                     log ? first_error(log) : "", program->options);
        free(log);
    }
    return status == CL_SUCCESS;
}

Program *program_create(Device *device, const char *source, size_t length, const char *options, Error *error)
{
    Program *program = calloc(1, sizeof *program);
    if (!program) {
        error_set(error, ERROR_MEMORY, "no memory for the program");
        return NULL;
    }
    program->device = device;
    program->source = source;
    program->length = length;
    if (!build(program, options, error)) {
        program_destroy(program);
        return NULL;
    }
    return program;
}

void program_destroy(Program *program)
{
    if (!program)
        return;
    if (program->program)
        clReleaseProgram(program->program);
    free(program->options);
    free(program);
}
