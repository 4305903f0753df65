// OpenCL status codes as text and as Error. Private to this module.
#ifndef CLRT_DEVICE_STATUS_H
#define CLRT_DEVICE_STATUS_H

#include <CL/cl.h>

#include "base/error.h"

// "CL_DEVICE_NOT_FOUND" for -1 and so on; "unknown OpenCL error" for a code that is in no table.
const char *status_name(cl_int status);

// Sets *error to "CALL: CL_NAME (-N): message" and returns false. The code is ERROR_MEMORY where the status
// says that memory was refused, else ERROR_DEVICE.
bool status_error(Error *error, cl_int status, const char *call, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
