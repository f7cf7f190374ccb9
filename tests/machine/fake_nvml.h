#ifndef FAKE_NVML_H
#define FAKE_NVML_H

/* The answers of the fake NVML, and how it was used. */
struct FakeNvml {
    int init_result; /* 0 is success, here and below */
    int handle_result;
    int clock_result;
    int applications_clock_result;
    int reasons_result;
    unsigned int clock; /* MHz */
    unsigned int memory_clock;
    unsigned int applications_clock;
    unsigned int greatest_clock;
    unsigned int temperature;
    unsigned int milliwatts;
    unsigned int power_limit; /* mW */
    unsigned long long millijoules;
    int energy_result;
    unsigned int load; /* percent */
    unsigned long long reasons;
    char address[64]; /* that was asked for */
    int users;        /* initialised less shut down */
    int lock_result;
    unsigned int locked_least; /* MHz or a code; 0: not locked */
    unsigned int locked_most;
};

#endif
