@HEAD@
// State z: @STATES@.
// Inputs u: @INPUTS@; held during a step.

#include <math.h>

#define CREEPAGE_N @N@
#define CREEPAGE_M @M@
#define CREEPAGE_P @P@
/* Measured values, inputs that are commanded, and what of a motion these decide. */
#define CREEPAGE_K @K@
#define CREEPAGE_COMMANDED @COMMANDED@
#define CREEPAGE_T @T@

/* Fitted parameters and their covariance. */
static const char *const creepage_parameter_names[CREEPAGE_P + 1] = @NAMES@;
static const double creepage_covariance[CREEPAGE_P + 1][CREEPAGE_P + 1] = @COVARIANCE@;

static inline double creepage_sign(double x) { return (x > 0.0) - (x < 0.0); }
static inline double creepage_heaviside(double x) { return x > 0.0 ? 1.0 : 0.0; }

/* dz/dt, and its derivatives by (z, u) where asked for. */
static void creepage_rates(const double z[CREEPAGE_N], const double u[CREEPAGE_M], double rate[CREEPAGE_N],
                           double by[CREEPAGE_N][CREEPAGE_N + CREEPAGE_M])
{
@READ@@VALUES@@RATES@    for (int i = 0; i < CREEPAGE_N; i++)
        for (int j = 0; j < CREEPAGE_N + CREEPAGE_M; j++) by[i][j] = 0.0;
@SLOPES@}

/* The state after dt by one Runge-Kutta step of order four; jacobian = d(new z)/d(z, u). */
static void creepage_step(double z[CREEPAGE_N], const double u[CREEPAGE_M], double dt,
                          double jacobian[CREEPAGE_N][CREEPAGE_N + CREEPAGE_M])
{
    enum { N = CREEPAGE_N, C = CREEPAGE_N + CREEPAGE_M };
    static const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    double at[N], rate[N] = {0}, total[N] = {0}, by[N][C], w[N][C], slope[N][C] = {{0}}, sum[N][C] = {{0}};
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < N; i++) {
            at[i] = z[i] + ahead[k]*dt*rate[i];
            for (int j = 0; j < C; j++) w[i][j] = (i == j ? 1.0 : 0.0) + ahead[k]*dt*slope[i][j];
        }
        creepage_rates(at, u, rate, by);
        for (int i = 0; i < N; i++) {
            total[i] += weight[k]/6.0*rate[i];
            for (int j = 0; j < C; j++) {
                slope[i][j] = j < N ? 0.0 : by[i][j];
                for (int l = 0; l < N; l++) slope[i][j] += by[i][l]*w[l][j];
                sum[i][j] += weight[k]/6.0*slope[i][j];
            }
        }
    }
    for (int i = 0; i < N; i++) {
        z[i] += dt*total[i];
        for (int j = 0; j < C; j++) jacobian[i][j] = (i == j ? 1.0 : 0.0) + dt*sum[i][j];
    }
}

/* Variances: what each state wanders beside the model in a second, and of each measured value. */
static const double creepage_walk[CREEPAGE_N] = @WALK@;
static const double creepage_noise[CREEPAGE_K] = @NOISE@;

/* What the sensor measures (x, y, then angles), and its derivatives by z. */
static inline void creepage_measured(const double z[CREEPAGE_N], double y[CREEPAGE_K],
                                     double by[CREEPAGE_K][CREEPAGE_N])
{
@READ_MEASURED@@VALUES_MEASURED@@MEASURED@    for (int i = 0; i < CREEPAGE_K; i++)
        for (int j = 0; j < CREEPAGE_N; j++) by[i][j] = 0.0;
@SLOPES_MEASURED@}

/* One step of an extended Kalman filter: ahead by dt under held inputs, then a measurement, whose values come one after another;
   angles are compared without whole turns, and a value that is no number is not taken in. */
static inline void creepage_observer(double state[CREEPAGE_N], double covariance[CREEPAGE_N][CREEPAGE_N],
                                     const double inputs[CREEPAGE_M], const double measurement[CREEPAGE_K], double dt)
{
    enum { N = CREEPAGE_N, K = CREEPAGE_K };
    const double turn = 6.283185307179586;
    double f[N][CREEPAGE_N + CREEPAGE_M], y[K], h[K][N], predicted[N], moved[N][N], gain[N];
    creepage_step(state, inputs, dt, f);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            moved[i][j] = 0.0;
            for (int k = 0; k < N; k++) moved[i][j] += f[i][k]*covariance[k][j];
        }
    for (int i = 0; i < N; i++) {
        predicted[i] = state[i];
        for (int j = 0; j < N; j++) {
            covariance[i][j] = i == j ? creepage_walk[i]*dt : 0.0;
            for (int k = 0; k < N; k++) covariance[i][j] += moved[i][k]*f[j][k];
        }
    }
    creepage_measured(predicted, y, h);
    for (int m = 0; m < K; m++) {
        double off = measurement[m] - y[m], expected = creepage_noise[m], column[N];
        if (!(off == off)) continue;
        if (m > 1) off -= turn*floor(off/turn + 0.5);
        for (int i = 0; i < N; i++) {
            off -= h[m][i]*(state[i] - predicted[i]);
            column[i] = 0.0;
            for (int j = 0; j < N; j++) column[i] += covariance[i][j]*h[m][j];
        }
        for (int i = 0; i < N; i++) expected += h[m][i]*column[i];
        for (int i = 0; i < N; i++) gain[i] = column[i]/expected;
        for (int i = 0; i < N; i++) {
            state[i] += gain[i]*off;
            for (int j = 0; j < N; j++) covariance[i][j] -= gain[i]*column[j];
        }
    }
}

/* How far inputs and hidden states are from a wanted motion of the reference point (@TWIST@) with hidden states at rest. */
static inline double creepage_off(const double twist[CREEPAGE_T], const double z[CREEPAGE_N], const double u[CREEPAGE_M],
                                  double off[], double slope[][CREEPAGE_COMMANDED + CREEPAGE_N - CREEPAGE_K])
{
    enum { N = CREEPAGE_N, K = CREEPAGE_K, L = CREEPAGE_COMMANDED, T = CREEPAGE_T };
    double rate[N], by[N][CREEPAGE_N + CREEPAGE_M], sum = 0.0;
    const double c = cos(z[2]), s = sin(z[2]);
    creepage_rates(z, u, rate, by);
    for (int i = 0; i < T + N - K; i++) {
        const int turning = i == T - 1 && T > 1;
        const double x = i == 0 ? c : -s, y = i == 0 ? s : c;
        const int from = i < T ? 2 : K + i - T;
        const int plain = turning || i >= T;
        off[i] = (plain ? rate[from] : x*rate[0] + y*rate[1]) - (i < T ? twist[i] : 0.0);
        for (int j = 0; j < L + N - K; j++) {
            const int at = j < L ? N + j : K + j - L;
            slope[i][j] = plain ? by[from][at] : x*by[0][at] + y*by[1][at];
        }
        sum += off[i]*off[i];
    }
    return sum;
}

/* Inputs under which the reference point comes to move as wanted (@TWIST@; m/s and rad/s), hidden states at rest, by the method of
   Levenberg and Marquardt from the inputs that are given. 1 where they are found; 0 where not, and the inputs stay. */
static inline int creepage_inverse(const double twist[CREEPAGE_T], const double state[CREEPAGE_N], double inputs[CREEPAGE_M])
{
    enum { N = CREEPAGE_N, M = CREEPAGE_M, L = CREEPAGE_COMMANDED, H = CREEPAGE_N - CREEPAGE_K, U = L + H, E = CREEPAGE_T + H };
    double z[N], u[M], other_z[N], other_u[M], off[E], slope[E][U], a[U][U + 1], damping = 1e-6;
    for (int i = 0; i < N; i++) z[i] = state[i];
    for (int i = 0; i < M; i++) u[i] = inputs[i];
    for (int pass = 0; pass < 200; pass++) {
        const double here = creepage_off(twist, z, u, off, slope);
        if (here < 1e-18) {
            for (int i = 0; i < M; i++) inputs[i] = u[i];
            return 1;
        }
        for (int i = 0; i < U; i++) {
            for (int j = 0; j <= U; j++) {
                a[i][j] = 0.0;
                for (int e = 0; e < E; e++) a[i][j] += slope[e][i]*(j < U ? slope[e][j] : -off[e]);
            }
            a[i][i] += damping*(a[i][i] + 1e-6);
        }
        for (int i = 0; i < U; i++)
            for (int r = 0; r < U; r++) {
                const double factor = r == i ? 0.0 : a[r][i]/a[i][i];
                for (int j = i; j <= U; j++) a[r][j] -= factor*a[i][j];
            }
        for (int i = 0; i < N; i++) other_z[i] = i < CREEPAGE_K ? z[i] : z[i] + a[L + i - CREEPAGE_K][U]/a[L + i - CREEPAGE_K][L + i - CREEPAGE_K];
        for (int i = 0; i < M; i++) other_u[i] = i < L ? u[i] + a[i][U]/a[i][i] : u[i];
        if (creepage_off(twist, other_z, other_u, off, slope) < here) {
            for (int i = 0; i < N; i++) z[i] = other_z[i];
            for (int i = 0; i < M; i++) u[i] = other_u[i];
            damping = damping > 1e-12 ? 0.1*damping : damping;
        } else {
            damping *= 10.0;
        }
    }
    return 0;
}
