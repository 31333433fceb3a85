// The forward pass of the pruner: ranges of the clauses over 16 boxes, in binary32. Included by tile_impl.h
// alone, once for each instruction set. What has no form in lanes goes through Job::general. Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_blends.h"
#include "frep/eval/tile_freeform.h"
#include "frep/eval/tile_functions.h"
#include "frep/eval/tile_noise.h"
#include "frep/eval/tile_smooth.h"
#include "frep/eval/tile_sums.h"

namespace frep::tile {
namespace {

/// b where the condition surely holds, c where it surely does not, else both. Returns the flags.
std::uint32_t selection(const Job& job, Reader clause, Row& r) {
    const Row &condition = job.rows[clause.in(0)], &b = job.rows[clause.in(1)], &d = job.rows[clause.in(2)];
    const Truth t = truth_of(condition);
    const std::uint32_t fc = job.flags[clause.in(0)], fb = job.flags[clause.in(1)],
                        fd = job.flags[clause.in(2)];
    for (int k = 0; k < 16; ++k) {
        const bool yes = t.yes >> k & 1u, no = t.no >> k & 1u;
        const float lo = b.lo[k] < d.lo[k] ? b.lo[k] : d.lo[k], hi = b.hi[k] > d.hi[k] ? b.hi[k] : d.hi[k];
        r.lo[k] = yes ? b.lo[k] : no ? d.lo[k] : lo;
        r.hi[k] = yes ? b.hi[k] : no ? d.hi[k] : hi;
    }
    const std::uint32_t yes = t.yes | t.yes << 16, no = t.no | t.no << 16, open = ~(yes | no);
    const std::uint32_t undecided = ((fb | fd) & 0xffffu) | (fb & fd & 0xffff0000u);
    return fc | (fb & yes) | (fd & no) | (undecided & open);
}

/// The range of a clause of two operands; false where it has no form in lanes.
bool arithmetic(const Job& job, Reader clause, bool smooth, Row& r, std::uint32_t& f, unsigned& bad) {
    const Row &a = job.rows[clause.in(0)], &b = job.rows[clause.in(1)];
    const auto scale_of = [&](int k) {
        // a constant of ordinary size, else 0
        if (clause.in(k) >= job.constants) return 0.0f;
        const float x = job.rows[clause.in(k)].lo[0], size = x < 0 ? -x : x;
        return size > 1e-20f && size < 1e20f && job.flags[clause.in(k)] == 0 ? x : 0.0f;
    };
    switch (clause.op()) {
        case Op::add:
            f |= sum<false>(a, b, r);
            if (smooth) smooth_range({job, clause}, false, r);
            return true;
        case Op::sub:
            f |= sum<true>(a, b, r);
            if (smooth) smooth_range({job, clause}, true, r);
            return true;
        case Op::mul:
            if (const float x = scale_of(0); x != 0 && scaled<false>(b, x, r)) return true;
            if (const float x = scale_of(1); x != 0 && scaled<false>(a, x, r)) return true;
            f |= product(a, b, r);
            return true;
        case Op::div:
            if (const float x = scale_of(1); x != 0 && scaled<true>(a, x, r)) return true;
            if (!quotient(a, b, r)) bad = 0xffffu;
            return true;
        case Op::min:
            minimum(a, b, r);
            return true;
        case Op::max:
            maximum(a, b, r);
            return true;
        case Op::hypot:
            bad = hypotenuse(a, b, r);
            return true;
        case Op::pow:
            return power(job, clause, r);
        case Op::r_and:
            bad = r_function<false>(a, b, r);
            return true;
        case Op::r_or:
            bad = r_function<true>(a, b, r);
            return true;
        case Op::less:
            put_truth(comparison<false>(a, b), r);
            return true;
        case Op::less_equal:
            put_truth(comparison<true>(a, b), r);
            return true;
        case Op::logical_and: {
            const Truth s = truth_of(a), t = truth_of(b);
            put_truth({s.yes & t.yes, s.no | t.no}, r);
            return true;
        }
        case Op::logical_or: {
            const Truth s = truth_of(a), t = truth_of(b);
            put_truth({s.yes | t.yes, s.no & t.no}, r);
            return true;
        }
        default:
            return false;
    }
}

/// The range of a clause of one operand; false where it has no form in lanes.
bool one_operand(Reader clause, const Row& a, Row& r, std::uint32_t& f, unsigned& bad) {
    switch (clause.op()) {
        case Op::neg:
            negation(a, r);
            return true;
        case Op::square:
            square(a, r);
            return true;
        case Op::abs:
            absolute(a, r);
            return true;
        case Op::sqrt: {
            unsigned none = 0;
            f |= square_root(a, r, none);
            f |= none << 16;
            return true;
        }
        case Op::exp:
            exponential(a, r);
            return true;
        case Op::sin:
            bad = wave<0>(a, r);
            return true;
        case Op::cos:
            bad = wave<1>(a, r);
            return true;
        case Op::floor:
            rounding<Op::floor>(a, r);
            return true;
        case Op::ceil:
            rounding<Op::ceil>(a, r);
            return true;
        case Op::trunc:
            rounding<Op::trunc>(a, r);
            return true;
        case Op::round:
            rounding_to_nearest(a, r);
            return true;
        case Op::truth:
            put_truth(truth_of(a), r);
            return true;
        case Op::logical_not: {
            const Truth t = truth_of(a);
            put_truth({t.no, t.yes}, r);
            return true;
        }
        default:
            return false;
    }
}

void forward(const Job& job) {
    const auto* at = static_cast<const unsigned char*>(job.clauses);
    bool smooth = false;  // smooth set operations may come
    for (std::uint32_t i = 0; i < job.clause_count; ++i, at += clause_bytes) {
        const Reader clause{at};
        const std::uint32_t out = clause.out();
        Row& r = job.rows[out];
        bool done = false;
        std::uint32_t f = 0;
        unsigned bad = 0;
        if (clause.listed()) {
            if (clause.op() == Op::bezier_volume)
                done = bezier_range(job, clause, r, f, bad);
            else
                done = blended(job, clause, r, f, bad) || summed(job, clause, r, f, bad);
        } else {
            if (clause.count() == 2) {
                f = job.flags[clause.in(0)] | job.flags[clause.in(1)];
                done = arithmetic(job, clause, smooth, r, f, bad);
            } else if (clause.count() == 1) {
                f = job.flags[clause.in(0)];
                if (clause.op() == Op::square) smooth = smooth || is_square_of_maximum({job, clause});
                done = one_operand(clause, job.rows[clause.in(0)], r, f, bad);
            } else if (clause.op() == Op::select) {
                f = selection(job, clause, r);
                done = true;
            } else if (clause.op() == Op::lattice_noise) {
                bad = noise_of(job, clause, r, f);
                done = true;
            }
        }
        job.flags[out] = f;
        if (!done) bad = 0xffffu;
        if (bad != 0) job.general(job.self, i, bad);
    }
}

}  // namespace
}  // namespace frep::tile
