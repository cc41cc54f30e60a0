#include "multigrid/shared_nodes.h"

#include <algorithm>
#include <map>
#include <span>

namespace thermocontact::multigrid {
namespace {

using parallel::Exchange;
using parallel::Message;
using Nodes = std::vector<std::int32_t>;

template <typename T>
void put(Message& message, std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    message.bytes.insert(message.bytes.end(), bytes.begin(), bytes.end());
}

/// Reads a message from its begin.
class Reader {
  public:
    explicit Reader(const Message& message) : rest_(message.bytes) {}

    template <typename T>
    std::vector<T> take(std::size_t count) {
        std::vector<T> result(count);
        std::memcpy(result.data(), rest_.data(), count * sizeof(T));
        rest_ = rest_.subspan(count * sizeof(T));
        return result;
    }

  private:
    std::span<const std::byte> rest_;
};

template <typename T>
std::vector<T> values_at(const std::vector<T>& values, const Nodes& nodes, std::size_t stride) {
    std::vector<T> result;
    result.reserve(nodes.size() * stride);
    for (const std::int32_t node : nodes) {
        const auto first = values.begin() + node * static_cast<std::ptrdiff_t>(stride);
        result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(stride));
    }
    return result;
}

using Row = std::map<std::int32_t, std::vector<float>>;

Row row_of(const Rows& rows, std::int32_t node) {
    Row result;
    const auto i = static_cast<std::size_t>(node);
    for (auto entry = rows.offsets[i]; entry < rows.offsets[i + 1]; ++entry) {
        const auto first = rows.values.begin() + entry * static_cast<std::ptrdiff_t>(rows.length);
        result[rows.columns[static_cast<std::size_t>(entry)]].assign(
            first, first + static_cast<std::ptrdiff_t>(rows.length));
    }
    return result;
}

void put_row(Message& message, const Row& row) {
    const auto count = static_cast<std::int32_t>(row.size());
    put(message, std::span(&count, 1));
    for (const auto& [column, block] : row) {
        put(message, std::span(&column, 1));
        put(message, std::span<const float>(block));
    }
}

void add_row(Reader& reader, std::size_t length, Row& row) {
    const auto count = reader.take<std::int32_t>(1)[0];
    for (std::int32_t k = 0; k < count; ++k) {
        const auto column = reader.take<std::int32_t>(1)[0];
        const auto block = reader.take<float>(length);
        std::vector<float>& sum = row[column];
        sum.resize(length, 0.0F);
        std::ranges::transform(sum, block, sum.begin(), std::plus<>());
    }
}

}  // namespace

SharedNodes::SharedNodes(parallel::NodeNumbers numbers, const parallel::Team& team)
    : numbers_(std::move(numbers)), team_(&team) {
    std::map<int, Neighbour> neighbours;
    for (std::size_t node = 0; node < node_count(); ++node) {
        if (!owned(node)) {
            const auto next = std::ranges::upper_bound(numbers_.first, numbers_.global[node]);
            const auto rank = static_cast<int>(next - numbers_.first.begin()) - 1;
            neighbours[rank].theirs.push_back(static_cast<std::int32_t>(node));
        }
    }
    std::vector<Message> messages;
    for (const auto& [rank, neighbour] : neighbours) {
        Message& message = messages.emplace_back(Message{rank, {}});
        for (const std::int32_t node : neighbour.theirs) {
            const std::int32_t global = numbers_.global[static_cast<std::size_t>(node)];
            put(message, std::span(&global, 1));
        }
    }
    Nodes local(static_cast<std::size_t>(numbers_.end() - numbers_.begin()));
    for (std::size_t node = 0; node < node_count(); ++node) {
        if (owned(node)) {
            local[static_cast<std::size_t>(numbers_.global[node] - numbers_.begin())] =
                static_cast<std::int32_t>(node);
        }
    }
    for (const Message& message : team.deliver(messages)) {
        Reader reader(message);
        for (const std::int32_t global :
             reader.take<std::int32_t>(message.bytes.size() / sizeof(std::int32_t))) {
            neighbours[message.rank].ours.push_back(
                local[static_cast<std::size_t>(global - numbers_.begin())]);
        }
    }
    for (auto& [rank, neighbour] : neighbours) {
        neighbour.rank = rank;
        neighbours_.push_back(std::move(neighbour));
    }
}

template <typename T>
void SharedNodes::add_up(std::vector<T>& values, std::size_t stride) const {
    if (neighbours_.empty()) {
        return;
    }
    std::vector<std::vector<T>> sent, received;
    std::vector<Exchange> exchanges;
    const auto swap = [&](Nodes Neighbour::*send, Nodes Neighbour::*receive) {
        sent.clear();
        received.clear();
        exchanges.clear();
        for (const Neighbour& neighbour : neighbours_) {
            sent.push_back(values_at(values, neighbour.*send, stride));
            received.emplace_back((neighbour.*receive).size() * stride);
            exchanges.push_back({neighbour.rank, std::as_bytes(std::span(sent.back())),
                                 std::as_writable_bytes(std::span(received.back()))});
        }
        team_->exchange(exchanges);
    };
    const auto put_in = [&](Nodes Neighbour::*where, auto&& put_value) {
        for (std::size_t k = 0; k < neighbours_.size(); ++k) {
            const T* from = received[k].data();
            for (const std::int32_t node : neighbours_[k].*where) {
                for (std::size_t c = 0; c < stride; ++c) {
                    put_value(values[static_cast<std::size_t>(node) * stride + c], *from++);
                }
            }
        }
    };
    swap(&Neighbour::theirs, &Neighbour::ours);
    put_in(&Neighbour::ours, [](T& sum, T value) { sum += value; });
    swap(&Neighbour::ours, &Neighbour::theirs);
    put_in(&Neighbour::theirs, [](T& copy, T value) { copy = value; });
}

template void SharedNodes::add_up(std::vector<float>&, std::size_t) const;
template void SharedNodes::add_up(std::vector<double>&, std::size_t) const;

void SharedNodes::keep_owned(std::vector<float>& values, std::size_t stride) const {
    for (const Neighbour& neighbour : neighbours_) {
        for (const std::int32_t node : neighbour.theirs) {
            std::fill_n(values.begin() + node * static_cast<std::ptrdiff_t>(stride), stride, 0.0F);
        }
    }
}

void SharedNodes::add_up(Rows& rows) const {
    if (team_->size() == 1) {
        return;
    }
    std::map<std::int32_t, Row> shared;
    std::vector<Message> messages;
    for (const Neighbour& neighbour : neighbours_) {
        Message& message = messages.emplace_back(Message{neighbour.rank, {}});
        for (const std::int32_t node : neighbour.theirs) {
            put_row(message, row_of(rows, node));
        }
        for (const std::int32_t node : neighbour.ours) {
            shared.try_emplace(node, row_of(rows, node));
        }
    }
    const auto find = [&](int rank) -> const Neighbour& {
        return *std::ranges::lower_bound(neighbours_, rank, {}, &Neighbour::rank);
    };
    for (const Message& message : team_->deliver(messages)) {
        Reader reader(message);
        for (const std::int32_t node : find(message.rank).ours) {
            add_row(reader, rows.length, shared[node]);
        }
    }
    messages.clear();
    for (const Neighbour& neighbour : neighbours_) {
        Message& message = messages.emplace_back(Message{neighbour.rank, {}});
        for (const std::int32_t node : neighbour.ours) {
            put_row(message, shared[node]);
        }
    }
    for (const Message& message : team_->deliver(messages)) {
        Reader reader(message);
        for (const std::int32_t node : find(message.rank).theirs) {
            add_row(reader, rows.length, shared[node]);  // shared holds no own row of these
        }
    }
    Rows result{rows.length, {0}, {}, {}};
    for (std::int32_t node = 0; node + 1 < static_cast<std::int32_t>(rows.offsets.size()); ++node) {
        const auto found = shared.find(node);
        if (found != shared.end()) {
            for (const auto& [column, block] : found->second) {
                result.columns.push_back(column);
                result.values.insert(result.values.end(), block.begin(), block.end());
            }
        } else {
            const auto begin = rows.offsets[static_cast<std::size_t>(node)];
            const auto end = rows.offsets[static_cast<std::size_t>(node) + 1];
            const auto length = static_cast<std::ptrdiff_t>(rows.length);
            result.columns.insert(result.columns.end(), rows.columns.begin() + begin,
                                  rows.columns.begin() + end);
            result.values.insert(result.values.end(), rows.values.begin() + begin * length,
                                 rows.values.begin() + end * length);
        }
        result.offsets.push_back(static_cast<std::int32_t>(result.columns.size()));
    }
    rows = std::move(result);
}

double SharedNodes::dot(const std::vector<float>& a, const std::vector<float>& b, std::size_t stride) const {
    double sum = 0;
    for (std::size_t node = 0; node < node_count(); ++node) {
        if (owned(node)) {
            for (std::size_t k = node * stride; k < (node + 1) * stride; ++k) {
                sum += static_cast<double>(a[k]) * static_cast<double>(b[k]);
            }
        }
    }
    return team_->sum(sum);
}

}  // namespace thermocontact::multigrid
