/* A solid of your own in C: a mass, a damper and a spring at each interface node, backward Euler,
 *   m (V - us)/dt + c V + k (ys + dt V) = load,  y = ys + dt V,  u = V;  ys, us: at the start of the step.
 * Build: cc spring_solid.c -ltether_client. Case file: coupling.programs.solid: /path/to/spring_solid */
#include <math.h>
#include <string.h>
#include <tether.h>

enum { around = 6, along = 3, n = 3 * around * along };
static double points[n], ys[n], us[n], y[n], v[n], state[2 * n], dt;
static int64_t triangles[6 * around * (along - 1)];
static double m = 1, c = 2, k = 50;

static void make_tube(void) { /* the interface: radius 1, length 2; normals away from the axis, out of the fluid */
  int64_t* t = triangles;
  for (int i = 0; i < around * along; ++i) {
    const double angle = 2 * M_PI * (i % around) / around;
    points[3 * i] = cos(angle), points[3 * i + 1] = sin(angle), points[3 * i + 2] = 2.0 * (i / around) / (along - 1);
  }
  for (int i = 0; i < around * (along - 1); ++i, t += 6) {
    const int64_t next = i / around * around + (i + 1) % around;
    const int64_t corners[6] = {i, next, next + around, i, next + around, i + around};
    memcpy(t, corners, sizeof corners);
  }
}

static int answer(tether_partner* p, const tether_request* r) {
  const double tangent = m / dt + c + k * dt;
  switch (r->kind) {
    case TETHER_SET_PARAMETERS: k = r->values.data[r->values.size - 1]; return tether_reply(p, 0, 0);
    case TETHER_GET_STATE: memcpy(state, ys, sizeof ys), memcpy(state + n, us, sizeof us);
      return tether_reply(p, &(tether_array){state, 2 * n}, 1);
    case TETHER_SET_STATE: memcpy(ys, r->values.data, sizeof ys), memcpy(us, r->values.data + n, sizeof us);
      return tether_reply(p, 0, 0);
    case TETHER_BEGIN_STEP: dt = r->dt; return tether_reply(p, 0, 0);
    case TETHER_SOLID_EVALUATE:
      for (int i = 0; i < n; ++i) v[i] = (r->load.data[i] + m * us[i] / dt - k * ys[i]) / tangent, y[i] = ys[i] + dt * v[i];
      return tether_reply(p, (tether_array[]){{y, n}, {v, n}}, 2);
    case TETHER_END_STEP:
      if (r->accepted) memcpy(ys, y, sizeof y), memcpy(us, v, sizeof v);
      return tether_reply(p, &(tether_array){0, 0}, 1); /* no observables */
    case TETHER_WRITE: return tether_reply(p, 0, 0);
    default: return tether_fail(p, "spring_solid does not know this request");
  }
}

int main(void) {
  const tether_parameter stiffness = {"stiffness", "of every spring", "dyn/cm", "log2", 50, 0, 0, 1e9, 1};
  tether_partner* p = tether_connect("solid", TETHER_NO_COMMUNICATOR);
  if (!p) return 1;
  make_tube();
  tether_introduce(p, &(tether_description){.program = "spring solid 1", .has_state = 1, .state_size = 2 * n,
      .parameter_count = 1, .parameters = &stiffness, .node_count = n / 3, .points = points,
      .triangle_count = 2 * around * (along - 1), .triangles = triangles});
  for (tether_request r; tether_next(p, &r) == 1;) answer(p, &r);
  return tether_end(p);
}
