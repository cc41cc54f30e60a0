#include "parallel/backend.h"

#include <mpi.h>
#include <petscsys.h>

#include <chrono>
#include <cstdlib>
#include <initializer_list>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "petsc/check.h"
#include "petsc/krylov.h"
#include "stopwatch.h"

namespace thermocontact::petsc {
namespace {

/// Seconds that a failing process waits for the others to fail as well, and how much longer each waits than
/// the one before it: of several, not of all, the first one tells, and ends the others before they do.
constexpr double patience = 3.0, more_patience = 0.3;

class MpiTeam final : public parallel::Team {
  public:
    using Team::max;
    using Team::sum;
    MpiTeam() {
        MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
        MPI_Comm_size(PETSC_COMM_WORLD, &size_);
    }
    int rank() const override { return rank_; }
    int size() const override { return size_; }
    void sum(std::span<double> numbers) const override { reduce(numbers, MPI_SUM); }
    void max(std::span<double> numbers) const override { reduce(numbers, MPI_MAX); }

    std::vector<parallel::Message> deliver(const std::vector<parallel::Message>& messages) const override {
        std::vector<int> leaving(static_cast<std::size_t>(size_), -1), coming(leaving.size());
        for (const parallel::Message& message : messages) {
            leaving[static_cast<std::size_t>(message.rank)] = static_cast<int>(message.bytes.size());
        }
        MPI_Alltoall(leaving.data(), 1, MPI_INT, coming.data(), 1, MPI_INT, PETSC_COMM_WORLD);
        std::vector<parallel::Message> result;
        std::vector<MPI_Request> requests;
        for (int rank = 0; rank < size_; ++rank) {
            if (const int length = coming[static_cast<std::size_t>(rank)]; length >= 0) {
                result.push_back({rank, std::vector<std::byte>(static_cast<std::size_t>(length))});
                MPI_Irecv(result.back().bytes.data(), length, MPI_BYTE, rank, tag, PETSC_COMM_WORLD,
                          &requests.emplace_back());
            }
        }
        for (const parallel::Message& message : messages) {
            MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, message.rank,
                      tag, PETSC_COMM_WORLD, &requests.emplace_back());
        }
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
        return result;
    }

    void exchange(std::span<const parallel::Exchange> exchanges) const override {
        std::vector<MPI_Request> requests;
        requests.reserve(2 * exchanges.size());
        for (const parallel::Exchange& with : exchanges) {
            MPI_Irecv(with.receive.data(), static_cast<int>(with.receive.size()), MPI_BYTE, with.rank, tag,
                      PETSC_COMM_WORLD, &requests.emplace_back());
        }
        for (const parallel::Exchange& with : exchanges) {
            MPI_Isend(with.send.data(), static_cast<int>(with.send.size()), MPI_BYTE, with.rank, tag,
                      PETSC_COMM_WORLD, &requests.emplace_back());
        }
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }

  private:
    static constexpr int tag = 1;

    void reduce(std::span<double> numbers, MPI_Op operation) const {
        if (size_ > 1) {
            MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE,
                          operation, PETSC_COMM_WORLD);
        }
    }

    int rank_ = 0, size_ = 1;
};

void set_unless_given(std::initializer_list<std::pair<const char*, const char*>> choices) {
    for (const auto& [name, value] : choices) {
        setenv(name, value, 0);
    }
}

/// Open MPI prepares a process that mpirun did not start for starting others, and any process for every
/// network it knows. Alone it needs neither: 0.1 s instead of 0.35 s; several on one node need none of the
/// networks: 0.1 s instead of 0.3 s. What the user sets stays.
void spare_networks() {
    const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
    const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    if (all != nullptr && here != nullptr) {
        if (std::string_view(all) == here) {
            set_unless_given({{"OMPI_MCA_pml", "ob1"}});
        }
    } else if (std::getenv("PMI_SIZE") == nullptr && std::getenv("PMIX_RANK") == nullptr) {
        set_unless_given(
            {{"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_btl", "self"}, {"OMPI_MCA_pml", "ob1"}});
#if OMPI_MAJOR_VERSION < 5  // later ones have neither
        set_unless_given({{"OMPI_MCA_osc", "pt2pt"}});
        // one folder serves all such processes of a user: the first to end takes it from one that begins
        set_unless_given({{"OMPI_MCA_orte_create_session_dirs", "0"}});
#endif
    }
}

/// The words behind "--", with the program's name before them.
std::vector<char*> petsc_words(int argc, char** argv) {
    std::vector<char*> words{argv[0]};
    bool behind = false;
    for (int i = 1; i < argc; ++i) {
        if (behind) {
            words.push_back(argv[i]);
        }
        behind = behind || std::string_view(argv[i]) == "--";
    }
    words.push_back(nullptr);
    return words;
}

class PetscBackend final : public parallel::Backend {
  public:
    PetscBackend(int argc, char** argv) : words_(petsc_words(argc, argv)) {
        spare_networks();
        auto count = static_cast<int>(words_.size()) - 1;
        char** words = words_.data();
        check(PetscInitialize(&count, &words, nullptr, nullptr));
        PetscPopSignalHandler();                                  // SIGINT and SIGTERM are the driver's
        PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);  // check() tells of errors
        team_ = std::make_unique<MpiTeam>();
        MPI_Comm_dup(PETSC_COMM_WORLD, &meeting_);
    }
    ~PetscBackend() override {
        MPI_Comm_free(&meeting_);
        PetscFinalize();
    }
    PetscBackend(const PetscBackend&) = delete;
    PetscBackend& operator=(const PetscBackend&) = delete;

    const parallel::Team& team() const override { return *team_; }

    /// On a communicator of its own: whatever the others wait for meanwhile, it is not this.
    bool all_meet() const override {
        MPI_Request barrier = MPI_REQUEST_NULL;
        MPI_Ibarrier(meeting_, &barrier);
        const Stopwatch waited;
        int all_here = 0;
        while (all_here == 0 && waited.seconds() < patience + more_patience * team_->rank()) {
            MPI_Test(&barrier, &all_here, MPI_STATUS_IGNORE);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return all_here != 0;
    }

    [[noreturn]] void abort(int code) const override {
        MPI_Abort(PETSC_COMM_WORLD, code);
        std::abort();
    }

    void enter_phase(const char* name) const override {
        PetscLogStage stage = -1;
        check(PetscLogStageGetId(name, &stage));
        if (stage < 0) {
            check(PetscLogStageRegister(name, &stage));
        }
        check(PetscLogStagePush(stage));
    }
    void leave_phase() const override { PetscLogStagePop(); }

    std::unique_ptr<solve::Strategy> newton_krylov(const parallel::Part& part) const override {
        return std::make_unique<NewtonKrylov>(part, *team_);
    }

  private:
    std::vector<char*> words_;
    std::unique_ptr<MpiTeam> team_;
    MPI_Comm meeting_ = MPI_COMM_NULL;
};

}  // namespace
}  // namespace thermocontact::petsc

namespace thermocontact::parallel {

std::unique_ptr<Backend> open_backend(int argc, char** argv) {
    return std::make_unique<petsc::PetscBackend>(argc, argv);
}

void continue_with_petsc() {
    throw std::logic_error("PETSc is here already");
}

}  // namespace thermocontact::parallel
