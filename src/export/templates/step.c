@HEAD@
// State z: @STATES@.
// Inputs u: @INPUTS@; held during a step.

#include <math.h>

#define CREEPAGE_N @N@
#define CREEPAGE_M @M@
#define CREEPAGE_P @P@

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
