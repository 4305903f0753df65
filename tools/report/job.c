#include "job.h"

#include <string.h>

#include "folder.h"

const char *job_temporary(const Job *job, const char *name)
{
    return text_format(job->campaign->arena, "%s/%s", job->campaign->runner.folder, name);
}

Shot job_shot(const Job *job, const Candidate *candidate, u32 samples)
{
    return (Shot){.scene = job->scene,
                  .mode = candidate ? candidate->mode : NULL,
                  .width = job->width,
                  .height = job->height,
                  .samples = samples,
                  .image = job_temporary(job, "shot.pfm")};
}

Candidate *job_find(Job *job, const char *mode)
{
    for (u32 i = 0; i < job->candidate_count; i++)
        if (strcmp(job->candidates[i].mode->name, mode) == 0)
            return job->candidates[i].available ? &job->candidates[i] : NULL;
    return NULL;
}
