// Work-group helpers: who does which part of a queue, and compaction that keeps the order of the slots.
// GROUP is the number of work-items of a group: 1 on CPUs, where a work-item is a whole core.
#ifndef CLRT_KERNELS_STAGES_QUEUE_H
#define CLRT_KERNELS_STAGES_QUEUE_H

#include "stages/state.h"

#if GROUP > 1
#define GROUP_BARRIER() barrier(CLK_GLOBAL_MEM_FENCE | CLK_LOCAL_MEM_FENCE)
#define GROUP_ITEM ((uint)get_local_id(0))
#else
#define GROUP_BARRIER()
#define GROUP_ITEM 0u
#endif

// Queues are padded to whole batches, so that every index that is loaded is a slot.
#define QUEUE_PADDING (BATCH > LANES ? BATCH : LANES)

// Copies to `to` those of the count slots at `from` that have a bit of wanted in FLAGS, in order; returns how
// many, the same in every work-item. scratch: GROUP numbers.
OUTLINE uint queue_compact(const State *s, global const int *from, uint count, int wanted,
                                 global int *to, local uint *scratch)
{
    uint total = 0;
    GROUP_BARRIER();
#if GROUP > 1
    global const int *flags = s->ints + FLAGS * TILE_SLOTS;
    for (uint base = 0; base < count; base += GROUP) {
        const uint i = base + GROUP_ITEM;
        const uint keep = i < count && (flags[from[i]] & wanted) != 0 ? 1 : 0;
        scratch[GROUP_ITEM] = keep;
        GROUP_BARRIER();
        uint before = 0, sum = 0;
        for (uint k = 0; k < GROUP; k++) {
            before += k < GROUP_ITEM ? scratch[k] : 0;
            sum += scratch[k];
        }
        if (keep)
            to[total + before] = from[i];
        total += sum;
        GROUP_BARRIER();
    }
#else
    for (uint i = 0; i < count; i += LANES) {
        const Slots slots = slots_make(from, i, count);
        const vi flag = state_load_int(s, FLAGS, &slots);
        for (uint bits = vm_bits(((flag & wanted) != (vi)(0)) & slots.valid); bits; bits &= bits - 1)
            to[total++] = from[i + (uint)lowest_bit(bits)];
    }
#endif
    const uint end = (total + QUEUE_PADDING - 1) / QUEUE_PADDING * QUEUE_PADDING;
    for (uint i = total + GROUP_ITEM; i < end; i += GROUP)
        to[i] = 0;
    GROUP_BARRIER();
    return total;
}

#endif
