/* A computer's clock that is set: wall-clock time is that many nanoseconds later as the file $CLOCK_SET says. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static int64_t ahead(void)
{
    static volatile int64_t *set;
    if (!set) {
        const char *path = getenv("CLOCK_SET");
        int file = path ? open(path, O_RDONLY) : -1;
        void *found = file < 0 ? MAP_FAILED : mmap(0, sizeof *set, PROT_READ, MAP_SHARED, file, 0);
        if (file >= 0)
            close(file);
        if (found == MAP_FAILED)
            return 0;
        set = found;
    }
    return *set;
}

static int64_t real(void)
{
    static int (*get)(clockid_t, struct timespec *);
    struct timespec now;
    if (!get)
        get = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    get(CLOCK_REALTIME, &now);
    return now.tv_sec * INT64_C(1000000000) + now.tv_nsec + ahead();
}

int clock_gettime(clockid_t clock, struct timespec *now)
{
    static int (*get)(clockid_t, struct timespec *);
    if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) {
        int64_t t = real();
        now->tv_sec = t / 1000000000, now->tv_nsec = t % 1000000000;
        return 0;
    }
    if (!get)
        get = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    return get(clock, now);
}

int gettimeofday(struct timeval *now, void *zone)
{
    int64_t t = real();
    (void)zone;
    now->tv_sec = t / 1000000000, now->tv_usec = t % 1000000000 / 1000;
    return 0;
}

/* Who waits until a time of this clock waits on when it is set back: looked at every 5 ms. */
#define SLICE 5000000
#define MONOTONIC 2 /* in __wrefs of a condition: its clock is never set (glibc 2.25 and newer) */
#define UNTIL(waited)                                                                                                  \
    for (;;) {                                                                                                         \
        int64_t now = real(), left = until->tv_sec * INT64_C(1000000000) + until->tv_nsec - now;                       \
        int64_t end = now - ahead() + (left < SLICE ? left : SLICE);                                                   \
        struct timespec next = {end / 1000000000, end % 1000000000};                                                   \
        int result = waited;                                                                                           \
        if (result == 0 || left <= SLICE || (result > 0 ? result : errno) != ETIMEDOUT)                                \
            return result;                                                                                             \
    }

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until)
{
    static int (*wait)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *);
    if (!wait)
        wait = (int (*)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *))dlvsym(
            RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
    if (condition->__data.__wrefs & MONOTONIC)
        return wait(condition, mutex, until);
    UNTIL(wait(condition, mutex, &next))
}

int pthread_mutex_timedlock(pthread_mutex_t *mutex, const struct timespec *until)
{
    static int (*lock)(pthread_mutex_t *, const struct timespec *);
    if (!lock)
        lock = (int (*)(pthread_mutex_t *, const struct timespec *))dlsym(RTLD_NEXT, "pthread_mutex_timedlock");
    UNTIL(lock(mutex, &next))
}

int sem_timedwait(sem_t *semaphore, const struct timespec *until)
{
    static int (*wait)(sem_t *, const struct timespec *);
    if (!wait)
        wait = (int (*)(sem_t *, const struct timespec *))dlsym(RTLD_NEXT, "sem_timedwait");
    UNTIL(wait(semaphore, &next))
}
