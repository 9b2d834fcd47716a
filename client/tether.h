/* Tether's plain C interface for codes of your own: let your fluid or solid take the place of Tether's.
 *
 * A partner's life (docs/protocol.md has the whole story and complete examples):
 *
 *   tether_partner* partner = tether_connect("solid", TETHER_NO_COMMUNICATOR);
 *   ... read the case, set up ...
 *   tether_introduce(partner, &description);            or tether_refuse(partner, "case.yaml:7: ...")
 *   tether_request request;
 *   while (tether_next(partner, &request) == 1) {
 *     switch (request.kind) { case TETHER_SOLID_EVALUATE: ...; tether_reply(partner, arrays, 2); break; ... }
 *   }
 *   return tether_end(partner);
 *
 * Arrays of vectors are node by node, x0 y0 z0 x1 y1 z1 ..., in the order of the description's points.
 * Units are the case's.
 * Link with -ltether_client. All functions are to be called from one thread. If the master dies, the process is ended.
 */
#ifndef TETHER_H
#define TETHER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tether_partner tether_partner;

/* A number that the master may set by name. `absent`, `prior_deviation`, `scale`: NaN if undefined. */
typedef struct {
  const char *name, *meaning, *unit;
  const char* transform; /* "linear", "log", "log2", "bounded" */
  double value, absent, lower, upper, prior_deviation;
  double scale; /* how far from `absent` the value of a patient may be */
} tether_parameter;

/* A scalar that the partner reports after each step. */
typedef struct {
  const char *name, *unit;
} tether_observable;

/* What the partner is and can do. Zero what it has not. */
typedef struct {
  const char* program;   /* name and version */
  int has_tangent;       /* answers TETHER_FLUID_TANGENT or TETHER_SOLID_TANGENT */
  int has_operators;     /* a solid that answers TETHER_SOLID_RESIDUAL, _PRODUCT and _PRECONDITION */
  int has_state;         /* answers TETHER_GET_STATE and TETHER_SET_STATE */
  int has_velocity;      /* a fluid that answers TETHER_GET_VELOCITY */
  int64_t state_size;    /* numbers in a state */
  int64_t unknowns;      /* of a solid with operators: interface velocities first */
  int64_t parameter_count, observable_count;
  const tether_parameter* parameters;
  const tether_observable* observables;
  int64_t node_count, triangle_count;
  const double* points;        /* 3 node_count: reference positions of the interface nodes */
  const int64_t* triangles;    /* 3 triangle_count: node indices from 0, normals out of the fluid */
  int64_t region_count;
  const char* const* region_names; /* of the outer wall; a fluid has none */
  const int64_t* regions;      /* a region per triangle, -1 for none; or NULL */
  const char* effective_case;  /* JSON; or NULL */
} tether_description;

/* The values are the MPI tags (docs/protocol.md). The library itself answers those that are missing here. */
typedef enum {
  TETHER_SET_PARAMETERS = 2,       /* names[i] becomes values.data[i]              reply: nothing */
  TETHER_GET_STATE = 3,            /*                                              reply: the state */
  TETHER_SET_STATE = 4,            /* values                                       reply: nothing */
  TETHER_BEGIN_STEP = 5,           /* step, time, dt, displacement (predicted)     reply: nothing */
  TETHER_END_STEP = 6,             /* accepted                                     reply: the observables */
  TETHER_WRITE = 7,                /* step, time                                   reply: nothing */
  TETHER_FLUID_EVALUATE = 9,       /* displacement, velocity                       reply: load */
  TETHER_FLUID_TANGENT = 10,       /* velocity (change)                            reply: change of load */
  TETHER_SOLID_EVALUATE = 11,      /* load                                         reply: displacement, velocity */
  TETHER_SOLID_TANGENT = 12,       /* load (change)                                reply: changes of both */
  TETHER_SOLID_RESIDUAL = 13,      /* values (correction), load             reply: residual, displacement, velocity */
  TETHER_SOLID_PRODUCT = 14,       /* values (direction)                           reply: product */
  TETHER_SOLID_PRECONDITION = 15,  /* values (residual)                            reply: correction */
  TETHER_OBSERVE = 16,             /* time, values (points)                        reply: the seven arrays of Discrepancy */
  TETHER_GET_VELOCITY = 21         /* values (points of space, of a fluid)         reply: velocities, NaN outside the lumen */
} tether_kind;

typedef struct {
  const double* data;
  int64_t size;
} tether_array;

/* What the master asks. Fields that the kind does not mention are 0. Valid until the next call of tether_next. */
typedef struct {
  int kind; /* tether_kind */
  int accepted;
  int64_t step;
  double time, dt;
  const char* const* names; /* as many as values.size */
  tether_array values, displacement, velocity, load;
} tether_request;

#define TETHER_NO_COMMUNICATOR (-1)
#define TETHER_ALL_PROCESSES (-2)

/* Reaches the master. `role`: "fluid", "solid". `communicator` says which processes make up the code:
 *   TETHER_NO_COMMUNICATOR  this one (if MPI is not initialised, the library does it and ends it)
 *   TETHER_ALL_PROCESSES    all that run this program; on an mpirun line with several programs MPI_COMM_WORLD has more
 *   else                    those of a communicator, given as MPI_Comm_c2f(communicator)
 * All of them call this and tether_end; the other calls are for the leader, rank 0, alone. NULL on error. */
tether_partner* tether_connect(const char* role, int communicator);
/* The communicator of those processes: MPI_Comm_f2c(tether_communicator(partner)). */
int tether_communicator(const tether_partner* partner);
int tether_is_leader(const tether_partner* partner);
/* Folder for the partner's files. */
const char* tether_output(const tether_partner* partner);

/* Says what the partner is. The description may be freed afterwards. 0, or -1 on error. */
int tether_introduce(tether_partner* partner, const tether_description* description);
/* Instead of introducing it: its input is wrong, and the master will say so. Then tether_end. */
int tether_refuse(tether_partner* partner, const char* message);

/* Waits for a request, without using the processor: 1, or 0 if the job is over, or -1 on error. */
int tether_next(tether_partner* partner, tether_request* request);
/* The reply to the last request: `count` arrays as the kind says, 0 for nothing. 0, or -1 on error. */
int tether_reply(tether_partner* partner, const tether_array* arrays, int count);
/* Instead of a reply: what went wrong. The master may retry with a smaller step. */
int tether_fail(tether_partner* partner, const char* message);

/* Says goodbye and frees the partner. Returns the exit code for main; does not return if the job has failed. */
int tether_end(tether_partner* partner);

/* What the last call that returned NULL or -1 has to say. */
const char* tether_error(void);

#ifdef __cplusplus
}
#endif
#endif
