// The identity and the error budget of an image as JSON.
#ifndef CLRT_CLI_IDENTITY_JSON_H
#define CLRT_CLI_IDENTITY_JSON_H

#include <jansson.h>

#include "cli/identity.h"

// New references, NULL without memory. No member is left out: what is not known is null.
json_t *identity_json(const Identity *identity, u64 program_hash);
json_t *budget_json(const ErrorBudget *budget);
// Counts of values that no image should have.
json_t *health_json(const ErrorBudget *budget);

#endif
