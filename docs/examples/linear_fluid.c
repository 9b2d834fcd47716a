/* A fluid of your own in C: load = L0(t) - A V on each node, with a tangent, and MPI of its own (several processes).
 * Build: mpicc linear_fluid.c -ltether_client. Case file: coupling.programs.fluid: /path/to/linear_fluid */
#include <math.h>
#include <mpi.h>
#include <stdlib.h>
#include <tether.h>

enum { around = 6, along = 3, n = 3 * around * along };
static double points[n], load[n], now, next, report;
static int64_t triangles[6 * around * (along - 1)];

static void make_tube(void) { /* radius 1, length 2; triangles counterclockwise seen from outside: out of the fluid */
  for (int i = 0; i < around * along; ++i) {
    const double angle = 2 * M_PI * (i % around) / around;
    points[3 * i] = cos(angle), points[3 * i + 1] = sin(angle), points[3 * i + 2] = 2.0 * (i / around) / (along - 1);
  }
  for (int i = 0; i < around * (along - 1); ++i) {
    const int64_t side = i / around * around + (i + 1) % around;
    const int64_t corners[6] = {i, side, side + around, i, side + around, i + around};
    for (int j = 0; j < 6; ++j) triangles[6 * i + j] = corners[j];
  }
}

/* load = source along x - A V: the force of the fluid on the wall, at the end of the step */
static int reply_load(tether_partner* p, double source, const double* v) {
  for (int i = 0; i < n; ++i) {
    const double av = 0.5 * (2.5 * v[i] - (i >= 3 ? v[i - 3] : 0) - (i + 3 < n ? v[i + 3] : 0));
    load[i] = (i % 3 == 0 ? source : 0) - av;
  }
  return tether_reply(p, &(tether_array){load, n}, 1);
}

/* The velocity anywhere, as measurements of it need it: along the tube, none outside it. A code may leave this out. */
static int reply_velocity(tether_partner* p, const double* x, int64_t size) {
  double* v = malloc(size * sizeof *v);
  for (int64_t i = 0; i < size; i += 3) {
    const double r2 = x[i] * x[i] + x[i + 1] * x[i + 1];
    const int inside = r2 < 1 && x[i + 2] >= 0 && x[i + 2] <= 2;
    v[i] = v[i + 1] = inside ? 0 : NAN, v[i + 2] = inside ? sin(2 * now) * (1 - r2) : NAN;
  }
  const int done = tether_reply(p, &(tether_array){v, size}, 1);
  free(v);
  return done;
}

static int answer(tether_partner* p, const tether_request* r) {
  switch (r->kind) {
    case TETHER_GET_STATE: return tether_reply(p, &(tether_array){&now, 1}, 1);
    case TETHER_SET_STATE: now = r->values.data[0]; return tether_reply(p, 0, 0);
    case TETHER_BEGIN_STEP: next = r->time + r->dt; return tether_reply(p, 0, 0);
    case TETHER_FLUID_EVALUATE: return reply_load(p, 3 * sin(2 * next), r->velocity.data);
    case TETHER_FLUID_TANGENT: return reply_load(p, 0, r->velocity.data);
    case TETHER_END_STEP:
      if (r->accepted) now = next;
      report = 3 * sin(2 * now);
      return tether_reply(p, &(tether_array){&report, 1}, 1);
    case TETHER_GET_VELOCITY: return reply_velocity(p, r->values.data, r->values.size);
    case TETHER_WRITE: return tether_reply(p, 0, 0);
    default: return tether_fail(p, "linear_fluid does not know this request");
  }
}

int main(int argc, char** argv) {
  const tether_observable pressure = {"pressure", "dyn"};
  MPI_Init(&argc, &argv);
  tether_partner* p = tether_connect("fluid", TETHER_ALL_PROCESSES);
  if (!p) return 1;
  make_tube();
  if (tether_is_leader(p)) { /* a real code broadcasts each request: MPI_Comm_f2c(tether_communicator(p)) */
    tether_introduce(p, &(tether_description){.program = "linear fluid 1", .has_tangent = 1, .has_state = 1,
        .has_velocity = 1, .state_size = 1, .observable_count = 1, .observables = &pressure, .node_count = n / 3, .points = points,
        .triangle_count = 2 * around * (along - 1), .triangles = triangles});
    for (tether_request r; tether_next(p, &r) == 1;) answer(p, &r);
  }
  const int code = tether_end(p);
  MPI_Finalize();
  return code;
}
